//! One mistake, one message: what follows from it is not told as well.

use rc_beams::spec::read;

const BEAMS: [&str; 3] = [
    super::BEAM,
    include_str!("../../specimens/B-CO1.ron"),
    include_str!("../../specimens/A-SO3-2.ron"),
];

/// Begin and end of the first list of a field, if there is one.
fn list(beam: &str, field: &str) -> Option<(usize, usize)> {
    let begin = beam.find(&format!("{field}: ["))?;
    let line = beam[..begin].rfind('\n')?;
    let close = format!("{}],", &beam[line..begin]);
    Some((line, begin + beam[begin..].find(&close)?))
}

/// Begin and end of every number of a stretch of text.
fn numbers(beam: &str, (begin, end): (usize, usize)) -> Vec<(usize, usize)> {
    let colons = beam[begin..end].match_indices(": ");
    let starts = colons.map(|(i, _)| begin + i + 2);
    let length = |at: usize| beam[at..].find([',', ')']);
    let numbers = starts.filter_map(|at| Some((at, at + length(at)?)));
    numbers
        .filter(|(a, b)| beam[*a..*b].parse::<f64>().is_ok())
        .collect()
}

/// Target: each number of supports, loads, zones of stirrups and stretches of sheets set to others all over its range and
/// beyond.
#[test]
fn one_wrong_number_is_told_once() {
    let mut refused = 0;
    for beam in BEAMS {
        for field in ["supports", "loads", "zones", "stretches"] {
            let Some(within) = list(beam, field) else {
                continue;
            };
            for (begin, end) in numbers(beam, within) {
                for value in (-1..250).map(|i| 20.0 * f64::from(i)) {
                    let text = format!("{} {value:?}{}", &beam[..begin], &beam[end..]);
                    let Err(errors) = read("beam", &text) else {
                        continue;
                    };
                    refused += 1;
                    let line = &beam[..begin].lines().next_back().unwrap().trim();
                    assert_eq!(errors.len(), 1, "{line} {value}: {errors:#?}");
                }
            }
        }
    }
    assert!(refused > 1000, "{refused}");
}

#[test]
fn one_wrong_list_of_what_a_support_holds_is_told_once() {
    for beam in BEAMS {
        for held in ["held: [Uy]", "held: [Ux, Uy]"] {
            for (at, _) in beam.match_indices(held) {
                for other in ["", "Ux", "Uy, Uy", "Ux, Ux"] {
                    let rest = &beam[at + held.len()..];
                    let text = format!("{}held: [{other}]{rest}", &beam[..at]);
                    if let Err(errors) = read("beam", &text) {
                        assert_eq!(errors.len(), 1, "{held} -> {other}: {errors:#?}");
                    }
                }
            }
        }
    }
}

/// Target: a support that is not there takes all with it that it would hold.
#[test]
fn a_missing_support_is_told_once() {
    for beam in BEAMS {
        let (begin, end) = list(beam, "supports").unwrap();
        let first = begin + beam[begin..].find("        (\n").unwrap();
        let second = first + beam[first..].find("        ),\n").unwrap() + "        ),\n".len();
        for rest in [second, end + 1] {
            let text = format!("{}{}", &beam[..first], &beam[rest..]);
            let errors = read("beam", &text).unwrap_err();
            assert_eq!(errors.len(), 1, "{errors:#?}");
        }
    }
}
