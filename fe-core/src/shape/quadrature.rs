//! Gauss-Legendre rules and their tensor products, and the Gauss-Lobatto rule of three points.

/// Abscissae and weights of the `n`-point Gauss-Legendre rule on [-1, 1], n from 1 to 4; exact for
/// polynomials of degree 2n - 1. More points than 4 give the 4-point rule.
pub fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    match n {
        0 | 1 => vec![(0.0, 2.0)],
        2 => {
            let a = 1.0 / 3.0_f64.sqrt();
            vec![(-a, 1.0), (a, 1.0)]
        }
        3 => {
            let a = 0.6_f64.sqrt();
            vec![(-a, 5.0 / 9.0), (0.0, 8.0 / 9.0), (a, 5.0 / 9.0)]
        }
        _ => {
            let r = 2.0 / 7.0 * 1.2_f64.sqrt();
            let (a, b) = ((3.0 / 7.0 - r).sqrt(), (3.0 / 7.0 + r).sqrt());
            let s = 30.0_f64.sqrt();
            let (wa, wb) = ((18.0 + s) / 36.0, (18.0 - s) / 36.0);
            vec![(-b, wb), (-a, wa), (a, wa), (b, wb)]
        }
    }
}

/// Tensor-product rule with `n` points per direction on the square.
pub fn square(n: usize) -> Vec<([f64; 2], f64)> {
    let line = gauss_legendre(n);
    line.iter()
        .flat_map(|&(y, wy)| line.iter().map(move |&(x, wx)| ([x, y], wx * wy)))
        .collect()
}

/// Tensor product of the 3-point Gauss-Lobatto rule (Simpson's) on the square: points on the corners, the
/// mid-sides and the centre; exact for polynomials of degree 3 in each coordinate.
pub fn lobatto_square() -> Vec<([f64; 2], f64)> {
    let line = [(-1.0, 1.0 / 3.0), (0.0, 4.0 / 3.0), (1.0, 1.0 / 3.0)];
    line.iter()
        .flat_map(|&(y, wy)| line.iter().map(move |&(x, wx)| ([x, y], wx * wy)))
        .collect()
}

/// Tensor-product rule with `n` points per direction on the cube, the first coordinate fastest.
pub fn cube(n: usize) -> Vec<([f64; 3], f64)> {
    let line = gauss_legendre(n);
    let face = square(n);
    line.iter()
        .flat_map(|&(z, wz)| face.iter().map(move |&([x, y], w)| ([x, y, z], w * wz)))
        .collect()
}

/// The 14-point rule of the cube by Irons (1971), exact for polynomials of degree 5 like 3 x 3 x 3 Gauss points:
/// six points at (+-sqrt(19/30), 0, 0) of weight 320/361 and eight at (+-1, +-1, +-1) sqrt(19/33) of weight 121/361.
pub fn irons() -> Vec<([f64; 3], f64)> {
    let (inner, outer) = ((19.0_f64 / 30.0).sqrt(), (19.0_f64 / 33.0).sqrt());
    let corners = cube(2);
    let corners = corners
        .iter()
        .map(|(x, _)| (x.map(|c| outer.copysign(c)), 121.0 / 361.0));
    let faces = (0..6).map(|i| {
        let mut x = [0.0; 3];
        x[i / 2] = if i % 2 == 0 { -inner } else { inner };
        (x, 320.0 / 361.0)
    });
    corners.chain(faces).collect()
}

#[cfg(test)]
mod tests {
    //! Protects the exactness of the rules.
    use super::*;

    #[test]
    fn rules_integrate_polynomials_of_degree_2n_minus_1() {
        for n in 1..=4 {
            for degree in 0..2 * n {
                let sum: f64 = gauss_legendre(n)
                    .iter()
                    .map(|(x, w)| w * x.powf(degree as f64))
                    .sum();
                let exact = if degree % 2 == 0 {
                    2.0 / (degree as f64 + 1.0)
                } else {
                    0.0
                };
                assert!((sum - exact).abs() < 1e-14);
            }
        }
        let cubic: f64 = lobatto_square()
            .iter()
            .map(|([x, y], w)| w * (1.0 + x * x) * (2.0 + y * y * y))
            .sum();
        assert!((cubic - 32.0 / 3.0).abs() < 1e-14);
        assert!((cube(3).iter().map(|p| p.1).sum::<f64>() - 8.0).abs() < 1e-14);
    }

    #[test]
    fn fourteen_points_integrate_polynomials_of_degree_5() {
        let rule = irons();
        assert_eq!(rule.len(), 14);
        let line = |n: i32| {
            if n % 2 == 0 {
                2.0 / f64::from(n + 1)
            } else {
                0.0
            }
        };
        for (i, j, k) in (0..216).map(|n| (n / 36, n / 6 % 6, n % 6)) {
            if i + j + k <= 5 {
                let terms = rule.iter();
                let sum: f64 = terms
                    .map(|(x, w)| w * x[0].powi(i) * x[1].powi(j) * x[2].powi(k))
                    .sum();
                assert!(
                    (sum - line(i) * line(j) * line(k)).abs() < 1e-14,
                    "{i} {j} {k}"
                );
            }
        }
    }
}
