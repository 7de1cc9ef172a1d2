//! The law of the source, solved to equilibrium, against the loads that the source published for its own model: Soares,
//! dissertation, Universidade Federal do Rio Grande do Sul, 2022, chapter 6.

use super::cases::SOURCE;
use super::tables::{Outcomes, fixed, header, percent, row};

/// Loads (kN) of the source's model.
const PUBLISHED: [(&str, f64); 12] = [
    ("A-SO3-1", 151.0),
    ("A-SO4-1", 126.3),
    ("A-SW3-1", 249.9),
    ("A-SW4-1", 231.6),
    ("A-SO3-2", 235.0),
    ("A-SO3-3", 240.4),
    ("A-SO3-4", 337.1),
    ("A-SO3-5", 321.2),
    ("A-SO4-2", 240.5),
    ("A-SO4-3", 341.5),
    ("A-SW3-2", 355.3),
    ("A-SW4-2", 372.8),
];

/// Every beam: the load of the test, of the source's model and of its law in equilibrium.
pub fn table(outcomes: &Outcomes) -> String {
    let mut text = header(&[
        "beam",
        "test, kN",
        "model of the source, kN",
        "its law in equilibrium, kN",
        "over the model of the source, %",
        "load lost behind the peak, %",
        "trust",
    ]);
    for (beam, published) in PUBLISHED {
        let outcome = outcomes.get(&(SOURCE.name, beam));
        let number = |key| outcome?.number(&[key]);
        let peak = number("peak_load_kn");
        text += &row([
            beam.to_owned(),
            fixed(number("test_load_kn"), 1),
            fixed(Some(published), 1),
            fixed(peak, 1),
            percent(peak.map(|p| p / published - 1.0)),
            fixed(number("post_peak_drop").map(|drop| 100.0 * drop), 0),
            outcome
                .and_then(|o| o.text(&["trust"]))
                .unwrap_or_default()
                .to_owned(),
        ]);
    }
    text
}
