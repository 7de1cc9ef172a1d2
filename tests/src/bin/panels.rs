//! Writes the tables of `docs/panels.md`: panels in pure shear against their tests, with the default law and others.
//!
//! `cargo run --release -p fe-tests --bin panels`

use std::fmt::Write as _;

use fe_materials::fixed_crack::{CompressionSoftening, FixedCrackParameters, ShearTransfer};
use fe_tests::cube::Failure;
use fe_tests::document::fill;
use fe_tests::provenance::commit;
use fe_tests::sample::mean_and_variation;
use fe_tests::toronto::{AGGREGATE_MM, End, SPACING_MM, TESTS, Test};

const DOCUMENT: &str = "docs/panels.md";

/// What is changed in the default law.
type Change = fn(&mut FixedCrackParameters);

/// Name, change and distance of the cracks (mm).
const SETTINGS: [(&str, Change, f64); 12] = [
    ("default", |_| (), SPACING_MM),
    ("axes fixed at the onset", onset, SPACING_MM),
    ("axes fixed at 0.3 of ft", late, SPACING_MM),
    ("struts: `vecchio-collins-slip`", slip, SPACING_MM),
    ("struts: `none`", none, SPACING_MM),
    (
        "axes fixed at the onset, struts: `vecchio-collins-slip`",
        onset_slip,
        SPACING_MM,
    ),
    ("shear: `damage`", damage, SPACING_MM),
    ("aggregate 19 mm", large, SPACING_MM),
    ("a crack every 25 mm", |_| (), 25.0),
    ("a crack every 75 mm", |_| (), 75.0),
    (
        "a crack every 75 mm, struts: `vecchio-collins-slip`",
        slip,
        75.0,
    ),
    ("a crack every 100 mm", |_| (), 100.0),
];

/// Settings shown panel by panel.
const SHOWN: usize = 2;

fn onset(p: &mut FixedCrackParameters) {
    p.fixing_share = 1.0;
}

fn late(p: &mut FixedCrackParameters) {
    p.fixing_share = 0.3;
}

fn slip(p: &mut FixedCrackParameters) {
    p.compression_softening = CompressionSoftening::VecchioCollinsSlip;
}

fn none(p: &mut FixedCrackParameters) {
    p.compression_softening = CompressionSoftening::None;
}

fn onset_slip(p: &mut FixedCrackParameters) {
    onset(p);
    slip(p);
}

fn damage(p: &mut FixedCrackParameters) {
    p.shear_transfer = ShearTransfer::Damage;
}

fn large(p: &mut FixedCrackParameters) {
    p.shear_transfer = ShearTransfer::Interlock { aggregate_mm: 19.0 };
}

/// Ratios of model to test of all panels.
fn ratios(change: Change, side_mm: f64) -> Result<Vec<f64>, Failure> {
    let ratio = |test: &Test| {
        let mut concrete = FixedCrackParameters {
            shear_transfer: ShearTransfer::Interlock {
                aggregate_mm: AGGREGATE_MM,
            },
            ..test.concrete()
        };
        change(&mut concrete);
        test.ratio(concrete, side_mm)
    };
    TESTS.iter().map(ratio).collect()
}

fn main() -> Result<(), Failure> {
    let all = SETTINGS.map(|(_, change, side)| ratios(change, side));
    let all = all.into_iter().collect::<Result<Vec<_>, _>>()?;
    let mut panels = String::from(
        "| panel | fc, MPa | rho_x fy, MPa | rho_y fy, MPa | test, MPa | default, % | axes fixed at the onset, % |\n\
         | --- | --- | --- | --- | --- | --- | --- |\n",
    );
    for (i, test) in TESTS.iter().enumerate() {
        let [x, y] = test.steel.map(|s| s.ratio * s.yield_mpa);
        let mark = match test.end {
            End::Failure => "",
            End::Cracking => " at cracking",
            End::Edge => " or more",
        };
        write!(
            panels,
            "| {} | {:.1} | {x:.2} | {y:.2} | {:.2}{mark} |",
            test.name, test.fc_mpa, test.stress_mpa
        )?;
        for ratios in &all[..SHOWN] {
            write!(panels, " {:+.0} |", 100.0 * (ratios[i] - 1.0))?;
        }
        panels.push('\n');
    }
    let mut settings = String::from(
        "| setting | mean of model over test | coefficient of variation, % | mean, alike both ways | mean, unlike |\n\
         | --- | --- | --- | --- | --- |\n",
    );
    for ((name, ..), ratios) in SETTINGS.iter().zip(&all) {
        let of = |equal: &[bool]| -> Vec<f64> {
            let tests = TESTS.iter().zip(ratios);
            let tests =
                tests.filter(|(t, _)| t.end == End::Failure && equal.contains(&t.is_equal()));
            tests.map(|(_, r)| *r).collect()
        };
        let [mean, variation] = mean_and_variation(&of(&[true, false]));
        let [alike, _] = mean_and_variation(&of(&[true]));
        let [unlike, _] = mean_and_variation(&of(&[false]));
        writeln!(
            settings,
            "| {name} | {mean:.2} | {:.1} | {alike:.2} | {unlike:.2} |",
            100.0 * variation
        )?;
    }
    let source = format!(
        "Written at commit {} by `cargo run --release -p fe-tests --bin panels`.\n",
        commit()
    );
    let tables = [
        ("source", source),
        ("panels", panels),
        ("settings", settings),
    ];
    fill(DOCUMENT, tables)
}
