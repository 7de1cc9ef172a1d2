//! Mistakes in the description of fibre sheets.

use super::{BEAM, Case, check_cases};

const STRIPS: &str = include_str!("../../specimens/A-SO3-2.ron");
const CONTINUOUS: &str = include_str!("../../specimens/A-SO3-4.ron");
const FULL_WRAP: &str = include_str!("../../specimens/B-CF4.ron");
const STAGED: &str = include_str!("../../specimens/examples/A-SO3-4-staged.ron");

const ON_STRIPS: &[Case] = &[
    // Stronger than the formulas of the bond serve.
    (
        "reported_strength_mpa: 27.5",
        "reported_strength_mpa: 61",
        "61",
        &[
            "concrete.reported_strength_mpa: 61 MPa, with sheets",
            "allowed: 16 to 60 MPa",
        ],
    ),
    // Strips that overlap; in another order; outside the beam.
    (
        "x_from_mm: 807.5",
        "x_from_mm: 730",
        "730",
        &[
            "sheets.wraps[0].stretches[1].x_from_mm: left end of the stretch at 730 mm",
            "allowed: 735.5 to 3050 mm",
            "each behind the one to its left",
        ],
    ),
    (
        "x_to_mm: 2367.5",
        "x_to_mm: 3100",
        "3100",
        &[
            "sheets.wraps[0].stretches[13].x_to_mm: right end of the stretch at 3100 mm",
            "allowed: 0 to 3050 mm",
            "x is measured from the left end of the beam",
        ],
    ),
    (
        "x_to_mm: 732.5",
        "x_to_mm: 632.5",
        "632.5",
        &["sheets.wraps[0].stretches[0].x_to_mm: ends at 632.5 mm; allowed: more than 682.5 mm"],
    ),
    // Edges next to lines of the mesh: an end of the beam, a plate, and, of two wraps, another sheet.
    (
        "x_from_mm: 682.5",
        "x_from_mm: 661",
        "661",
        &[
            "sheets.wraps[0].stretches[0].x_from_mm: edge of the sheet at 661 mm, 1.000 mm from the edge of a plate at 660 mm",
            "allowed: on it, or 3 mm from it or more",
            "elements between the two would be as thin as that",
        ],
    ),
    (
        "from_mm: 0, to_mm: 305",
        "from_mm: 0, to_mm: 304.9",
        "304.9",
        &[
            "sheets.wraps[0].faces[0].to_mm: edge of the sheet at 304.9 mm, 0.100 mm from the edge of the beam at 305 mm",
        ],
    ),
    (
        "        wraps: [",
        "        wraps: [(name: \"patch\", source: \"\", \
         stretches: [(x_from_mm: 100, x_to_mm: 200)], \
         faces: [(face: Side, from_mm: 2, to_mm: 250, angles_deg: [90])]), ",
        "",
        &[
            "sheets.wraps[0].faces[0].from_mm: edge of the sheet at 2 mm, 2.000 mm from the edge of the beam at 0 mm",
        ],
    ),
    // A gauge from one strip to another.
    (
        "x_mm: 2092.5,\n                y_mm: 152.5,\n                z_mm: 75,\n                angle_deg: 90,\n                gauge_length_mm: 30,",
        "x_mm: 2092.5,\n                y_mm: 152.5,\n                z_mm: 75,\n                angle_deg: 0,\n                gauge_length_mm: 200,",
        "200",
        &["a gauge of 200 mm ends at x = 1992.5 mm, y = 152.5 mm, off its sheet"],
    ),
    // A gauge between strips; two of one name.
    (
        "x_mm: 2217.5",
        "x_mm: 2265",
        "2265",
        &[
            "measuring.sheet_gauges[0].x_mm: no sheet at x = 2265 mm, y = 152.5 mm",
            "allowed: where a sheet covers the side",
        ],
    ),
    (
        "name: \"sheet_x2092.5\"",
        "name: \"sheet_x2217.5\"",
        "",
        &["measuring.sheet_gauges[1].name: \"sheet_x2217.5\" names two gauges"],
    ),
    // A gauge named like a column that is there.
    (
        "name: \"sheet_x2092.5\"",
        "name: \"bottom x1370\"",
        "",
        &[
            "measuring.sheet_gauges[1].name: \"bottom x1370\" and \"bottom_x1370\" name gauges alike",
        ],
    ),
    // A wrap named like a strip of the one before.
    (
        "        wraps: [",
        "        wraps: [(name: \"U strips-2\", source: \"\", \
         stretches: [(x_from_mm: 100, x_to_mm: 150)], \
         faces: [(face: Side, from_mm: 0, to_mm: 305, angles_deg: [90])]), ",
        "",
        &["sheets.wraps[1].name: \"U strips 2\" and \"U strips-2\" name sheets alike"],
    ),
];

const ON_A_CONTINUOUS_SHEET: &[Case] = &[
    // Numbers of the ply.
    (
        "thickness_mm: 0.165",
        "thickness_mm: -0.165",
        "-0.165",
        &[
            "sheets.ply.thickness_mm: -0.165 mm is out of range",
            "allowed: 0.01 to 5 mm",
        ],
    ),
    (
        "fibre_modulus_mpa: 228000",
        "fibre_modulus_mpa: 228",
        "228",
        &[
            "sheets.ply.fibre_modulus_mpa: 228 MPa is out of range",
            "allowed: 10000 to 700000 MPa",
            "is it in GPa? Then write 228000",
        ],
    ),
    (
        "rupture_mpa: 3790",
        "rupture_mpa: NaN",
        "NaN",
        &["sheets.ply.rupture_mpa: NaN is not a finite number"],
    ),
    // Faces and plies.
    (
        "face: Soffit",
        "face: Bottom",
        "Bottom",
        &[
            "sheets.wraps[0].faces[1].face: no such choice",
            "allowed: Side, Soffit, Top",
        ],
    ),
    (
        "face: Soffit",
        "face: Side",
        "",
        &[
            "sheets.wraps[0].faces[1]: Side face covered twice between 670 and 2380 mm",
            "also by sheets.wraps[0].faces[0]; allowed: once",
            "list all plies of a place in one `angles_deg`",
        ],
    ),
    (
        "(face: Side, from_mm: 0, to_mm: 305, angles_deg: [90])",
        "(face: Side, from_mm: 0, to_mm: 150, angles_deg: [90]), (face: Side, from_mm: 150, to_mm: 305, angles_deg: [90])",
        "",
        &[
            "sheets.wraps[0].faces[1]: sheet on the Side face between 670 and 2380 mm touches sheets.wraps[0].faces[0]",
            "allowed: 3 mm between them, or more",
        ],
    ),
    (
        "to_mm: 305, angles_deg: [90]",
        "to_mm: 305, angles_deg: []",
        "[]",
        &["sheets.wraps[0].faces[0].angles_deg: plies: 0; allowed: at least 1"],
    ),
    (
        "to_mm: 305, angles_deg: [90]",
        "to_mm: 305, angles_deg: [inf]",
        "inf",
        &[
            "sheets.wraps[0].faces[0].angles_deg[0]: inf is not a finite number",
            "allowed: -90 to 90 degrees",
        ],
    ),
    (
        "to_mm: 75, angles_deg: [90]",
        "to_mm: 150, angles_deg: [90]",
        "150",
        &[
            "sheets.wraps[0].faces[1].to_mm: edge of the sheet at 150 mm",
            "allowed: 0 to 75 mm",
            "distances from the middle of the width",
        ],
    ),
    // A sheet between a support and the soffit.
    (
        "(x_from_mm: 670,",
        "(x_from_mm: 610,",
        "(x_from_mm: 610,",
        &[
            "sheets.wraps[0].stretches[0]: sheet on the Soffit face from 610 to 2380 mm, across the support",
            "allowed: up to 560 mm or from 660 mm",
            "end the stretch at the plate",
        ],
    ),
];

const ON_A_FULL_WRAP: &[Case] = &[
    (
        "(x_from_mm: 510, x_to_mm: 1325)",
        "(x_from_mm: 510, x_to_mm: 1400)",
        "(x_from_mm: 510",
        &[
            "sheets.wraps[0].stretches[0]: sheet on the Top face from 510 to 1400 mm, across the load",
            "allowed: up to 1325 mm or from 1425 mm",
        ],
    ),
    (
        "overlap_mm: 50",
        "overlap_mm: 200",
        "200",
        &[
            "sheets.wraps[0].faces[2].overlap_mm: sheet lies twice over 200 mm",
            "allowed: up to 150 mm",
        ],
    ),
    (
        "overlap_mm: 50",
        "overlap_mm: 0",
        "0",
        &[
            "sheets.wraps[0].faces[2].overlap_mm: 0 mm is out of range",
            "allowed: 1 to 2000 mm",
        ],
    ),
];

const ON_SHEETS_BONDED_UNDER_LOAD: &[Case] = &[
    (
        "hold: Hold",
        "hold: Held",
        "Held",
        &["staged.hold: no such choice", "allowed: Hold, Unload"],
    ),
    (
        "load_kn: 90",
        "load_kn: 90000",
        "90000",
        &[
            "staged.load_kn: 90000 kN is out of range",
            "is it in N? Then write 90",
        ],
    ),
];

/// A beam without sheets has nothing to bond under load.
const ON_A_BARE_BEAM: &[Case] = &[(
    "series: A,",
    "staged: (load_kn: 90, hold: Unload, source: \"\"), series: A,",
    "(load_kn",
    &[
        "staged: sheets bonded under load, but no sheets",
        "allowed: with `sheets` only",
    ],
)];

#[test]
fn mistakes_in_sheets_are_named_with_their_place() {
    check_cases(STRIPS, ON_STRIPS);
    check_cases(CONTINUOUS, ON_A_CONTINUOUS_SHEET);
    check_cases(FULL_WRAP, ON_A_FULL_WRAP);
    check_cases(BEAM, ON_A_BARE_BEAM);
    check_cases(STAGED, ON_SHEETS_BONDED_UNDER_LOAD);
}
