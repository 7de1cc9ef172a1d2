//! Mean and scatter of a sample.

/// Mean, and coefficient of variation with n - 1 degrees of freedom (-); not a number for fewer than two values.
pub fn mean_and_variation(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    [mean, (square / (n - 1.0)).sqrt() / mean]
}

#[cfg(test)]
mod tests {
    //! Protects the figures of documents.
    use super::*;

    #[test]
    fn a_sample_of_three() {
        let [mean, variation] = mean_and_variation(&[8.0, 10.0, 12.0]);
        assert!((mean - 10.0).abs() < 1e-12 && (variation - 0.2).abs() < 1e-12);
        assert!(mean_and_variation(&[1.0])[1].is_nan());
    }
}
