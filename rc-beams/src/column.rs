//! Names as columns of tables.

/// Name of the shear span under test; its columns begin with it.
pub(crate) const TEST_SPAN: &str = "test span";

/// Columns of `gauges.csv` that are no gauge.
pub(crate) const GAUGE_COLUMNS: [&str; 2] = ["deflection_mm", "load_kn"];

/// Column of the gauge on a longitudinal bar at `x` (mm).
pub(crate) fn bar_gauge(bar: &str, x: f64) -> String {
    format!("{}_x{x}", slug(bar))
}

/// A name as part of a column: its words in small letters, joined by underscores.
pub(crate) fn slug(name: &str) -> String {
    let plain = name.to_lowercase();
    let words = plain.split(|c: char| !c.is_alphanumeric());
    let words: Vec<&str> = words.filter(|w| !w.is_empty()).collect();
    words.join("_")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Protects tables from columns that a comma in the name of a bar would break.
    #[test]
    fn the_name_of_a_bar_becomes_part_of_a_column() {
        assert_eq!(bar_gauge("bottom", 1525.0), "bottom_x1525");
        assert_eq!(bar_gauge("Top, outer", 682.5), "top_outer_x682.5");
    }
}
