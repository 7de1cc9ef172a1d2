//! A bare beam of von Mises material as CalculiX reads it, and its time there: a reference run in pairs with ours.

use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use fe_core::dof::Dof;

use crate::beam::BareBeam;

/// Young's modulus, Poisson's ratio, yield stress and hardening modulus (MPa).
#[derive(Debug, Clone, Copy)]
pub struct Metal {
    /// Young's modulus (MPa).
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Yield stress (MPa).
    pub yield_stress: f64,
    /// Slope of the stress over the plastic strain (MPa).
    pub hardening: f64,
}

/// What a run gave, there or here.
#[derive(Debug, Clone, Copy)]
pub struct Reference {
    /// Sum of the vertical reactions of the supports at the end (N).
    pub reaction: f64,
    /// Iterations of all increments.
    pub iterations: usize,
    /// Processor time of the process (s).
    pub cpu_s: f64,
}

/// The beam with 8-point hexahedra, its load lines moved down by `deflection` (mm) in `increments`.
///
/// # Errors
///
/// When the text cannot be written.
pub fn deck(
    beam: &BareBeam,
    metal: Metal,
    deflection: f64,
    increments: usize,
) -> Result<String, std::fmt::Error> {
    let mesh = beam.model.mesh();
    let mut text = String::from("*NODE\n");
    for (n, x) in mesh.nodes().iter().enumerate() {
        writeln!(text, "{}, {}, {}, {}", n + 1, x[0], x[1], x[2])?;
    }
    text.push_str("*ELEMENT, TYPE=C3D20R, ELSET=ALL\n");
    let cells = mesh.blocks().iter().flat_map(fe_core::mesh::Block::cells);
    for (e, cell) in cells.enumerate() {
        // Nodes of C3D20 come in the order of ours; at most 16 entries a line.
        let nodes: Vec<String> = cell.iter().map(|n| (n + 1).to_string()).collect();
        let (first, second) = (nodes[..15].join(", "), nodes[15..].join(", "));
        writeln!(text, "{}, {first},\n{second}", e + 1)?;
    }
    let Metal {
        young,
        poisson,
        yield_stress,
        hardening,
    } = metal;
    writeln!(
        text,
        "*MATERIAL, NAME=METAL\n*ELASTIC\n{young}, {poisson}\n*PLASTIC\n{yield_stress}, 0\n{}, 1\n*SOLID SECTION, \
         ELSET=ALL, MATERIAL=METAL\n*NSET, NSET=SUPPORTS",
        yield_stress + hardening
    )?;
    for n in &beam.supports {
        writeln!(text, "{},", n + 1)?;
    }
    let mut fixed = String::new();
    let mut moved = String::new();
    for (&dof, rate) in beam.conditions.prescribed() {
        let (node, kind) = beam.model.dofs().owner(dof);
        let Some(k) = Dof::DISPLACEMENTS.iter().position(|d| *d == kind) else {
            continue;
        };
        let (node, k) = (node + 1, k + 1);
        if *rate == 0.0 {
            writeln!(fixed, "{node}, {k}, {k}")?;
        } else {
            writeln!(moved, "{node}, {k}, {k}, {}", rate * deflection)?;
        }
    }
    let increment = 1.0 / increments as f64;
    write!(
        text,
        "*BOUNDARY\n{fixed}*STEP, INC={}\n*STATIC, DIRECT\n{increment}, 1.0\n*BOUNDARY\n{moved}*NODE PRINT, \
         NSET=SUPPORTS, TOTALS=ONLY, FREQUENCY={increments}\nRF\n*END STEP\n",
        2 * increments
    )?;
    Ok(text)
}

/// Runs a deck in `folder`; none if CalculiX (`ccx`) is not installed.
///
/// # Errors
///
/// When the run fails or its output cannot be read.
pub fn solve(deck: &str, folder: &Path) -> Result<Option<Reference>, Box<dyn Error>> {
    fs::write(folder.join("beam.inp"), deck)?;
    let before = children_cpu_s()?;
    let started = Command::new("ccx")
        .arg("beam")
        .current_dir(folder)
        .env("OMP_NUM_THREADS", "1")
        .stdin(Stdio::null())
        .output();
    let output = match started {
        Ok(output) => output,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error.into()),
    };
    let cpu_s = children_cpu_s()? - before;
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let iterations = said
        .lines()
        .filter(|l| l.trim_start().starts_with("iteration "))
        .count();
    let dat = fs::read_to_string(folder.join("beam.dat"))?;
    let totals = dat.lines().rfind(|l| !l.trim().is_empty());
    let reaction = totals.and_then(|l| l.split_whitespace().nth(1)?.parse().ok());
    let Some(reaction) = reaction.filter(|_| output.status.success()) else {
        return Err(format!("ccx failed: {}", said.lines().last().unwrap_or_default()).into());
    };
    Ok(Some(Reference {
        reaction,
        iterations,
        cpu_s,
    }))
}

/// Processor time of this process, or of its children that have ended (s).
fn cpu_s(first_field: usize) -> Result<f64, Box<dyn Error>> {
    let stat = fs::read_to_string("/proc/self/stat")?;
    let after_name = stat.rsplit(')').next().unwrap_or_default();
    let fields: Vec<&str> = after_name.split_whitespace().collect();
    let ticks = |k: usize| fields.get(k).and_then(|f| f.parse::<f64>().ok());
    // Linux counts in hundredths of a second.
    match (ticks(first_field), ticks(first_field + 1)) {
        (Some(user), Some(system)) => Ok((user + system) / 100.0),
        _ => Err("no processor times in /proc/self/stat".into()),
    }
}

/// Processor time of this process (s).
///
/// # Errors
///
/// Where there is no `/proc`.
pub fn own_cpu_s() -> Result<f64, Box<dyn Error>> {
    cpu_s(11)
}

fn children_cpu_s() -> Result<f64, Box<dyn Error>> {
    cpu_s(13)
}

#[cfg(test)]
mod tests {
    //! Protects the deck: every node, cell and condition of the beam is in it.
    use std::sync::Arc;

    use fe_core::kinematics::Solid;
    use fe_core::material::Material;
    use fe_elements::HexRule;

    use super::*;
    use crate::beam::bare_beam;
    use crate::laws::elastic;

    #[test]
    fn the_deck_holds_the_beam() {
        let law: Arc<dyn Material<Solid>> = elastic(30_000.0, 0.2).unwrap();
        let beam = bare_beam([10, 2, 1], HexRule::Reduced, &law).unwrap();
        let metal = Metal {
            young: 30_000.0,
            poisson: 0.2,
            yield_stress: 15.0,
            hardening: 20.0,
        };
        let deck = deck(&beam, metal, 10.0, 50).unwrap();
        let lines = |from: &str, to: &str| {
            let part = deck.split(from).nth(1).unwrap().split(to).next().unwrap();
            part.trim().lines().count()
        };
        assert_eq!(
            lines("*NODE\n", "*ELEMENT"),
            beam.model.mesh().nodes().len()
        );
        assert_eq!(lines("ELSET=ALL\n", "*MATERIAL"), 2 * 20);
        assert_eq!(lines("NSET=SUPPORTS\n", "*BOUNDARY"), beam.supports.len());
        let conditions = lines("*BOUNDARY\n", "*STEP") + lines("1.0\n*BOUNDARY\n", "*NODE PRINT");
        assert_eq!(conditions, beam.conditions.prescribed().len());
        assert!(deck.contains(", 2, 2, -10\n"), "{deck}");
    }
}
