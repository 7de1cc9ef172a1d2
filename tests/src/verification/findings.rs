//! What tests have found, from the lines that `fe_core::testing` prints.

use std::collections::BTreeMap;

use crate::cube::Failure;

/// One value that a test has held against its target.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// Quantity, with the case before it where it stands for one: `EL-05: deflection`.
    pub what: String,
    /// Its value.
    pub found: String,
    /// What it had to be.
    pub target: String,
}

impl Finding {
    /// The case that it stands for, if any, and the quantity.
    pub fn parts(&self) -> (Option<&str>, &str) {
        let is_case = |id: &str| {
            let kind = id.split('-').next().unwrap_or_default();
            ["EL", "MAT", "SH", "STR"].contains(&kind)
        };
        match self.what.split_once(": ") {
            Some((id, what)) if is_case(id) => (Some(id), what),
            _ => (None, &self.what),
        }
    }
}

/// The output of tests.
#[derive(Debug, Default, PartialEq)]
pub struct Findings {
    /// By source file and name of the test.
    tests: BTreeMap<(String, String), Vec<Finding>>,
    curves: BTreeMap<String, Vec<[f64; 2]>>,
}

impl Findings {
    /// Reads what `cargo test -- --show-output` has printed.
    ///
    /// # Errors
    ///
    /// A line that begins like a finding or a curve and is none.
    pub fn read(output: &str) -> Result<Self, Failure> {
        let mut all = Self::default();
        let mut test = "";
        for line in output.lines() {
            if let Some(name) = line
                .strip_prefix("---- ")
                .and_then(|l| l.strip_suffix(" stdout ----"))
            {
                test = name.rsplit("::").next().unwrap_or(name);
            } else if let Some(rest) = line.strip_prefix("finding | ") {
                let [file, what, found, target] = fields(rest, line)?;
                let finding = Finding {
                    what: what.into(),
                    found: found.into(),
                    target: target.into(),
                };
                let place = (file.to_owned(), test.to_owned());
                all.tests.entry(place).or_default().push(finding);
            } else if let Some(rest) = line.strip_prefix("curve | ") {
                let [_, name, points] = fields(rest, line)?;
                let points = points.split(", ").map(point).collect::<Option<_>>();
                let points = points.ok_or_else(|| format!("no points: {line}"))?;
                if all.curves.insert(name.into(), points).is_some() {
                    return Err(format!("two curves of the name {name}").into());
                }
            }
        }
        Ok(all)
    }

    /// What a test has found, in its order.
    pub fn of(&self, file: &str, test: &str) -> &[Finding] {
        let place = (file.to_owned(), test.to_owned());
        self.tests.get(&place).map_or(&[], Vec::as_slice)
    }

    /// Files and names of the tests that have found something.
    pub fn places(&self) -> impl Iterator<Item = (&str, &str)> {
        self.tests
            .keys()
            .map(|(file, test)| (file.as_str(), test.as_str()))
    }

    /// The points of a curve.
    ///
    /// # Errors
    ///
    /// A name that no test has told.
    pub fn curve(&self, name: &str) -> Result<&[[f64; 2]], Failure> {
        let curve = self.curves.get(name).map(Vec::as_slice);
        curve.ok_or_else(|| format!("no test tells a curve of the name {name}").into())
    }
}

fn fields<'a, const N: usize>(rest: &'a str, line: &str) -> Result<[&'a str; N], Failure> {
    let fields: Vec<_> = rest.split(" | ").collect();
    let fields = fields.try_into();
    fields.map_err(|_| format!("not {N} fields: {line}").into())
}

fn point(text: &str) -> Option<[f64; 2]> {
    let (x, y) = text.split_once(' ')?;
    Some([x.parse().ok()?, y.parse().ok()?])
}

#[cfg(test)]
mod tests {
    //! Protects the results of the verification manual.
    use super::*;

    const OUTPUT: &str = "running 2 tests\ntest a ... ok\n\nsuccesses:\n\n---- law::tests::loads stdout ----\n\
        finding | fe-x/src/law.rs | EL-05: load (N), 2 x 2 | 3.10 | 3 ± 0.2\nother words\n\
        finding | fe-x/src/law.rs | error: none | < 1e-13 | < 1e-12\n\n\
        ---- alone stdout ----\ncurve | tests/tests/alone.rs | path | 0 1, 0.5 -2e-3\n";

    #[test]
    fn lines_are_given_to_their_tests() {
        let findings = Findings::read(OUTPUT).unwrap();
        let loads = findings.of("fe-x/src/law.rs", "loads");
        assert_eq!(loads.len(), 2);
        assert_eq!(loads[0].parts(), (Some("EL-05"), "load (N), 2 x 2"));
        assert_eq!(
            (loads[0].found.as_str(), loads[0].target.as_str()),
            ("3.10", "3 ± 0.2")
        );
        assert_eq!(loads[1].parts(), (None, "error: none"));
        assert_eq!(findings.of("fe-x/src/law.rs", "alone"), []);
        let places: Vec<_> = findings.places().collect();
        assert_eq!(places, [("fe-x/src/law.rs", "loads")]);
        assert_eq!(findings.curve("path").unwrap(), [[0.0, 1.0], [0.5, -2e-3]]);
        assert!(findings.curve("loads").is_err());
    }

    #[test]
    fn lines_that_are_no_findings_are_refused() {
        for line in [
            "finding | a.rs | load | 3",
            "curve | a.rs | path | 1 2 3",
            "curve | a.rs | path | ",
        ] {
            assert!(Findings::read(line).is_err(), "{line}");
        }
    }
}
