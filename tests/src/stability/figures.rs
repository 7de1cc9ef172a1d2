//! A figure beside its target.

/// What a figure is held against.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target {
    /// A value, with its relative tolerance.
    Near(f64, f64),
    /// An upper bound.
    AtMost(f64),
    /// A lower bound.
    AtLeast(f64),
}

/// One measured figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// What it is, with its unit.
    pub name: String,
    /// What was found.
    pub found: f64,
    /// What it is held against.
    pub target: Target,
    /// What the catalogue has, of a target that is what was measured, with a margin; none of a target that is known.
    pub measured: Option<&'static str>,
}

impl Figure {
    /// A figure that is to be near a value.
    pub fn near(name: impl Into<String>, found: f64, value: f64, relative: f64) -> Self {
        Self::new(name, found, Target::Near(value, relative))
    }

    /// A figure with an upper bound.
    pub fn at_most(name: impl Into<String>, found: f64, bound: f64) -> Self {
        Self::new(name, found, Target::AtMost(bound))
    }

    /// A figure with a lower bound.
    pub fn at_least(name: impl Into<String>, found: f64, bound: f64) -> Self {
        Self::new(name, found, Target::AtLeast(bound))
    }

    fn new(name: impl Into<String>, found: f64, target: Target) -> Self {
        Self {
            name: name.into(),
            found,
            target,
            measured: None,
        }
    }

    /// The same whose target is what was measured, beside what the catalogue has.
    #[must_use]
    pub fn measured(self, catalogue: &'static str) -> Self {
        Self {
            measured: Some(catalogue),
            ..self
        }
    }

    /// Whether the target is met; never by a figure that is not a number.
    pub fn holds(&self) -> bool {
        match self.target {
            Target::Near(value, relative) => (self.found - value).abs() <= relative * value.abs(),
            Target::AtMost(bound) => self.found <= bound,
            Target::AtLeast(bound) => self.found >= bound,
        }
    }
}

#[cfg(test)]
mod tests {
    //! Protects the matrix from counting what is not a number as met.
    use super::*;

    #[test]
    fn a_figure_that_is_not_a_number_meets_no_target() {
        for figure in [
            Figure::near("a", f64::NAN, 1.0, 0.5),
            Figure::at_most("b", f64::NAN, 1.0),
            Figure::at_least("c", f64::NAN, 1.0),
        ] {
            assert!(!figure.holds(), "{figure:?}");
        }
        assert!(Figure::near("d", -1.01, -1.0, 0.011).holds());
        assert!(!Figure::near("e", -1.02, -1.0, 0.011).holds());
    }
}
