//! One mistake, one message: what follows from a wrong support is not told as well.

use rc_beams::spec::read;

const BEAMS: [&str; 3] = [
    super::BEAM,
    include_str!("../../specimens/B-CO1.ron"),
    include_str!("../../specimens/A-SO3-2.ron"),
];

/// Begin and end of the list of a field of the specimen.
fn list(beam: &str, field: &str) -> (usize, usize) {
    let begin = beam.find(&format!("\n    {field}: [")).unwrap();
    (begin, begin + beam[begin..].find("\n    ],").unwrap())
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

/// Target: each number of supports and loads set to others all over its range and beyond.
#[test]
fn one_wrong_number_of_a_support_is_told_once() {
    let mut refused = 0;
    for beam in BEAMS {
        for field in ["supports", "loads"] {
            for (begin, end) in numbers(beam, list(beam, field)) {
                for value in (-1..500).map(|i| 10.0 * f64::from(i)) {
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
        let (begin, end) = list(beam, "supports");
        let first = begin + beam[begin..].find("        (\n").unwrap();
        let second = first + beam[first..].find("        ),\n").unwrap() + "        ),\n".len();
        for rest in [second, end + 1] {
            let text = format!("{}{}", &beam[..first], &beam[rest..]);
            let errors = read("beam", &text).unwrap_err();
            assert_eq!(errors.len(), 1, "{errors:#?}");
        }
    }
}
