//! The scenarios of the catalogue, one file each, in its order.

mod stab01_strip;
mod stab05_crack_event;
mod stab06_many_steps;
mod stab07_skipped_event;
mod stab08_no_weak_cell;
mod stab09_traction;
mod stab10_nodal_stiffness;
mod stab11_stress_locking;
mod stab12_shear_retention;
mod stab13_return_mapping;
mod stab14_closing_crack;
mod stab15_hourglass;
mod stab16_coarse_bond;
mod stab17_conditioning;
mod stab18_loose_strip;
mod stab19_unsymmetric;
mod stab20_two_cracks;
mod stab21_notched;
mod stab22_tie;
mod stab23_bearing;
mod stab24_long_bar;
mod stab25_viscosity;

pub use stab01_strip::STRIP;
pub use stab14_closing_crack::sheared;
pub use stab24_long_bar::{LONG, LONGER};

use super::Scenario;

/// All of them.
pub const SCENARIOS: [Scenario; 26] = [
    stab01_strip::SCENARIO,
    stab05_crack_event::SCENARIO,
    stab06_many_steps::SCENARIO,
    stab07_skipped_event::SCENARIO,
    stab08_no_weak_cell::SCENARIO,
    stab09_traction::SCENARIO,
    stab10_nodal_stiffness::SCENARIO,
    stab11_stress_locking::ROTATING,
    stab11_stress_locking::DAMAGE,
    stab11_stress_locking::INTERLOCK,
    stab12_shear_retention::SCENARIO,
    stab13_return_mapping::SCENARIO,
    stab14_closing_crack::SCENARIO,
    stab14_closing_crack::SHEARED,
    stab15_hourglass::SCENARIO,
    stab16_coarse_bond::SCENARIO,
    stab17_conditioning::SCENARIO,
    stab18_loose_strip::SCENARIO,
    stab19_unsymmetric::SCENARIO,
    stab20_two_cracks::SCENARIO,
    stab21_notched::SHORT,
    stab22_tie::SCENARIO,
    stab23_bearing::SCENARIO,
    stab24_long_bar::BAR_1000,
    stab24_long_bar::BAR_2000,
    stab25_viscosity::SCENARIO,
];
