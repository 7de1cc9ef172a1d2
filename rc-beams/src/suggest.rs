//! Suggestions for mistyped names.

/// The candidate nearest to `word`, if it is near: at most a third of its letters differ.
pub(crate) fn nearest<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let word = word.to_lowercase();
    let near = |name: &&'a str| edits(&word, &name.to_lowercase());
    let best = candidates.into_iter().min_by_key(near)?;
    (3 * near(&best) <= best.len()).then_some(best)
}

/// Letters to insert, remove or replace to turn one word into the other (Wagner and Fischer 1974).
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, c) in a.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for j in 0..b.len() {
            let replaced = diagonal + usize::from(c != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    //! Protects the "did you mean" of messages.
    use super::*;

    #[test]
    fn near_names_are_suggested_and_far_ones_are_not() {
        let names = ["A-SO3-1", "A-SW3-1", "young_mpa"];
        assert_eq!(nearest("a-so31", names), Some("A-SO3-1"));
        assert_eq!(nearest("Young_MPa", names), Some("young_mpa"));
        assert_eq!(nearest("kitten", names), None);
        assert_eq!(edits("kitten", "sitting"), 3);
    }
}
