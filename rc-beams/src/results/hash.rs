//! A stable fingerprint of the input of a run.

/// FNV-1a with 64 bits (Fowler, Noll and Vo) of `parts`, with a byte 0xff, which no UTF-8 text holds,
/// between two of them. The same on every machine and in every version; no protection against forgery.
pub fn fnv1a_64(parts: &[&str]) -> u64 {
    const OFFSET_BASIS: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0100_0000_01b3;
    let bytes = parts
        .iter()
        .enumerate()
        .flat_map(|(i, part)| (i > 0).then_some(0xff).into_iter().chain(part.bytes()));
    bytes.fold(OFFSET_BASIS, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(PRIME)
    })
}

/// [`fnv1a_64`] as 16 hexadecimal digits.
pub fn fingerprint(parts: &[&str]) -> String {
    format!("{:016x}", fnv1a_64(parts))
}

#[cfg(test)]
mod tests {
    //! Protects the stability of the fingerprint; values from the test vectors of the authors of FNV
    //! (isthe.com/chongo/tech/comp/fnv, FNV-1a 64 bit).
    use super::*;

    #[test]
    fn published_vectors_are_met() {
        assert_eq!(fnv1a_64(&[""]), 0xcbf29ce484222325);
        assert_eq!(fnv1a_64(&["a"]), 0xaf63dc4c8601ec8c);
        assert_eq!(fnv1a_64(&["foobar"]), 0x85944171f73967e8);
    }

    #[test]
    fn the_border_between_parts_counts() {
        assert_ne!(fingerprint(&["ab", "c"]), fingerprint(&["a", "bc"]));
        assert_eq!(fingerprint(&["ab"]).len(), 16);
    }
}
