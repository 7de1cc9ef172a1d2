//! Specimens whose concrete differs from the reported one in one property.

/// The text of a specimen with a `property` of its concrete times `factor`; none if the concrete has no such number.
pub fn scaled(text: &str, property: &str, factor: f64) -> Option<String> {
    let concrete = text.find("concrete:")?;
    let name = format!("{property}:");
    let start = concrete + text[concrete..].find(&name)? + name.len();
    let end = start + text[start..].find(',')?;
    let value: f64 = text[start..end].trim().parse().ok()?;
    Some(format!(
        "{} {}{}",
        &text[..start],
        factor * value,
        &text[end..]
    ))
}

#[cfg(test)]
mod tests {
    //! Protects which number is changed: that of the concrete, and nothing else.
    use super::scaled;

    const TEXT: &str = "(plate: (young_mpa: 5,), concrete: (young_mpa: 25000, poisson: 0.2,), bar: (young_mpa: 7,))";

    #[test]
    fn one_number_of_the_concrete_is_changed() {
        let changed = TEXT.replace("25000", "20000");
        assert_eq!(scaled(TEXT, "young_mpa", 0.8), Some(changed));
        assert_eq!(scaled(TEXT, "density", 0.8), None);
    }
}
