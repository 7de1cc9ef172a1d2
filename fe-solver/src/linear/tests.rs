//! Protects the linear layer against dense references: solutions, inertia, singular models, repeatability.

use fe_core::sparsity::{MatrixValues, Sparsity};
use nalgebra::{DMatrix, DVector};

use super::{DirectSolver, Inertia, LinearError, LinearSolver, Ordering};

/// A small deterministic generator.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }
}

/// Chain of overlapping groups of five equations, like elements along a beam.
fn pattern(n: u32) -> Sparsity {
    let groups: Vec<Vec<u32>> = (0..n - 4)
        .step_by(2)
        .map(|i| (i..i + 5).collect())
        .collect();
    Sparsity::from_groups(n as usize, groups.iter().map(Vec::as_slice))
}

fn dense(p: &Sparsity, v: &MatrixValues) -> DMatrix<f64> {
    let upper = if v.is_symmetric() { &v.lower } else { &v.upper };
    let mut a = DMatrix::zeros(p.len(), p.len());
    for j in 0..p.len() {
        for k in p.column(j) {
            let i = p.row_idx()[k];
            a[(j, i)] = upper[k];
            a[(i, j)] = v.lower[k];
        }
    }
    a
}

/// Random values with the given diagonal.
fn values(
    p: &Sparsity,
    seed: u64,
    diagonal: impl Fn(usize) -> f64,
    unsymmetric: bool,
) -> MatrixValues {
    let mut random = Random(seed);
    let mut lower: Vec<f64> = (0..p.nnz()).map(|_| random.next()).collect();
    let mut upper: Vec<f64> = (0..p.nnz()).map(|_| random.next()).collect();
    for j in 0..p.len() {
        lower[p.col_ptr()[j]] = diagonal(j);
        upper[p.col_ptr()[j]] = diagonal(j);
    }
    if !unsymmetric {
        upper.clear();
    }
    MatrixValues { lower, upper }
}

fn solve(p: &Sparsity, v: &MatrixValues, b: &[f64]) -> (Vec<f64>, usize) {
    let mut solver = DirectSolver::default();
    solver.analyze(p).unwrap();
    let inertia = solver.factorize(v).unwrap();
    let mut x = b.to_vec();
    solver.solve_in_place(&mut x).unwrap();
    (x, inertia.negative)
}

#[test]
fn solutions_and_inertia_agree_with_dense_ones() {
    let p = pattern(41);
    let b: Vec<f64> = (0..41).map(|i| f64::from(i).sin()).collect();
    for negative in [0, 1, 4, 10, 30] {
        let v = values(
            &p,
            7 + negative as u64,
            |j| if j % 41 < negative { -4.0 } else { 4.0 },
            false,
        );
        let a = dense(&p, &v);
        let expected = a
            .clone()
            .symmetric_eigenvalues()
            .iter()
            .filter(|&&w| w < 0.0)
            .count();
        let (x, count) = solve(&p, &v, &b);
        assert_eq!(count, expected);
        let residual = &a * DVector::from_vec(x) - DVector::from_row_slice(&b);
        assert!(residual.norm() < 1e-12, "{negative}: {}", residual.norm());
    }
}

#[test]
fn unsymmetric_solutions_agree_with_dense_ones() {
    let p = pattern(41);
    let b: Vec<f64> = (0..41).map(|i| f64::from(i).cos()).collect();
    let v = values(&p, 3, |_| 3.0, true);
    let (x, _) = solve(&p, &v, &b);
    let residual = dense(&p, &v) * DVector::from_vec(x) - DVector::from_row_slice(&b);
    assert!(residual.norm() < 1e-12);
}

#[test]
fn a_free_chain_and_a_zero_row_are_refused_by_equation() {
    // Springs between neighbours, held nowhere: the rigid-body mode has no energy.
    let n = 12;
    let groups: Vec<Vec<u32>> = (0..n - 1).map(|i| vec![i, i + 1]).collect();
    let p = Sparsity::from_groups(n as usize, groups.iter().map(Vec::as_slice));
    let mut v = MatrixValues {
        lower: vec![-1.0; p.nnz()],
        upper: vec![],
    };
    for j in 0..n as usize {
        v.lower[p.col_ptr()[j]] = if j == 0 || j + 1 == n as usize {
            1.0
        } else {
            2.0
        };
    }
    let mut solver = DirectSolver::default();
    solver.analyze(&p).unwrap();
    assert!(matches!(
        solver.factorize(&v),
        Err(LinearError::Singular { .. })
    ));
    v.upper = v.lower.clone();
    assert!(matches!(
        solver.factorize(&v),
        Err(LinearError::Singular { .. })
    ));
    // An equation without stiffness in an otherwise sound matrix.
    let mut v = values(&p, 5, |_| 4.0, false);
    for j in 0..n as usize {
        for k in p.column(j) {
            if j == 6 || p.row_idx()[k] == 6 {
                v.lower[k] = 0.0;
            }
        }
    }
    let error = solver.factorize(&v);
    assert!(
        matches!(error, Err(LinearError::Singular { equation: 6, .. })),
        "{error:?}"
    );
}

#[test]
fn a_reused_analysis_gives_the_bits_of_a_fresh_one() {
    let p = pattern(33);
    let b: Vec<f64> = (0..33).map(f64::from).collect();
    let mut reused = DirectSolver::default();
    reused.analyze(&p).unwrap();
    for seed in 0..4 {
        let v = values(
            &p,
            seed,
            |j| if seed == 2 && j == 3 { -4.0 } else { 4.0 },
            false,
        );
        reused.factorize(&v).unwrap();
        let mut x = b.clone();
        reused.solve_in_place(&mut x).unwrap();
        if seed != 3 {
            assert_eq!(x, solve(&p, &v, &b).0);
        }
    }
}

#[test]
fn no_equations_and_no_factor_are_not_a_panic() {
    let p = Sparsity::from_groups(0, std::iter::empty::<&[u32]>());
    let mut solver = DirectSolver::default();
    assert_eq!(
        solver.solve_in_place(&mut []),
        Err(LinearError::NotAnalysed)
    );
    solver.analyze(&p).unwrap();
    solver.factorize(&MatrixValues::default()).unwrap();
    solver.solve_in_place(&mut []).unwrap();
}

/// Values and right-hand sides of another pattern are refused by name, factorised or not.
#[test]
fn what_has_another_length_is_refused() {
    let p = pattern(33);
    let sound = values(&p, 1, |_| 4.0, false);
    let mut solver = DirectSolver::default();
    solver.analyze(&p).unwrap();
    solver.factorize(&sound).unwrap();
    let cut = |mut v: MatrixValues| {
        v.lower.pop();
        v
    };
    let mut upper = sound.clone();
    upper.upper = sound.lower[1..].to_vec();
    let mismatch = |error| matches!(error, LinearError::Mismatch { .. });
    for n in [32, 34] {
        let mut rhs = vec![1.0; n];
        assert!(mismatch(solver.solve_in_place(&mut rhs).unwrap_err()));
        assert!(mismatch(solver.precondition(&mut rhs).unwrap_err()));
    }
    assert!(mismatch(solver.renew(&cut(sound.clone())).unwrap_err()));
    assert!(mismatch(solver.factorize(&cut(sound)).unwrap_err()));
    assert!(mismatch(solver.factorize(&upper).unwrap_err()));
}

/// Equations on the points of a grid, coupled within its cells; numbered along x.
fn grid(cells: [u32; 3], per_point: u32) -> Sparsity {
    let points = cells.map(|n| n + 1);
    let at = |x: u32, y: u32, z: u32| (x * points[1] + y) * points[2] + z;
    let mut groups = Vec::new();
    for x in 0..cells[0] {
        for y in 0..cells[1] {
            for z in 0..cells[2] {
                let corners = (0..8).map(|c| at(x + c / 4, y + c / 2 % 2, z + c % 2));
                let equations =
                    corners.flat_map(|p| (0..per_point).map(move |d| p * per_point + d));
                groups.push(equations.collect::<Vec<_>>());
            }
        }
    }
    let n = points.iter().product::<u32>() * per_point;
    Sparsity::from_groups(n as usize, groups.iter().map(Vec::as_slice))
}

/// Largest of |b - A x|.
fn defect(p: &Sparsity, v: &MatrixValues, x: &[f64], b: &[f64]) -> f64 {
    let mut y = vec![0.0; b.len()];
    v.multiply(p, x, &mut y);
    let parts = y.iter().zip(b).map(|(y, b)| (y - b).abs());
    parts.fold(0.0, f64::max)
}

#[test]
fn fronts_of_every_shape_solve_alike() {
    // Slender: from both ends. Flat: minimum degree. In one piece or in three, one of which has a single equation.
    let flat = grid([30, 30, 1], 1);
    let pieces: Vec<Vec<u32>> = vec![(0..40).collect(), vec![40], (41..50).collect()];
    let pieces = Sparsity::from_groups(50, pieces.iter().map(Vec::as_slice));
    for (p, ordering) in [
        (grid([40, 3, 2], 3), Ordering::TwoSided),
        (flat, Ordering::MinimumDegree),
        (pieces, Ordering::TwoSided),
    ] {
        let b: Vec<f64> = (0..p.len()).map(|i| (i as f64).sin()).collect();
        for (diagonal, unsymmetric, negative) in
            [(30.0, false, 0), (-30.0, false, p.len()), (30.0, true, 0)]
        {
            let v = values(&p, 11, |_| diagonal, unsymmetric);
            let mut solver = DirectSolver::default();
            solver.analyze(&p).unwrap();
            assert_eq!(solver.stats().ordering, ordering);
            assert_eq!(solver.factorize(&v).unwrap().negative, negative);
            let mut x = b.clone();
            solver.solve_in_place(&mut x).unwrap();
            let defect = defect(&p, &v, &x, &b);
            assert!(defect < 1e-13, "{ordering:?} {diagonal}: {defect}");
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let p = grid([60, 4, 4], 3);
    let b: Vec<f64> = (0..p.len()).map(|i| (i as f64).cos()).collect();
    for diagonal in [60.0, -60.0] {
        let v = values(&p, 5, |i| if i == 0 { 60.0 } else { diagonal }, false);
        let solutions = [1, 2, 4].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.unwrap().install(|| solve(&p, &v, &b))
        });
        assert_eq!(solutions[0], solutions[1]);
        assert_eq!(solutions[0], solutions[2]);
    }
}

#[test]
fn values_that_are_not_finite_are_named() {
    let p = grid([6, 2, 2], 3);
    for unsymmetric in [false, true] {
        for bad in [f64::NAN, f64::INFINITY] {
            let mut v = values(&p, 5, |_| 30.0, unsymmetric);
            v.lower[77] = bad;
            let mut solver = DirectSolver::default();
            solver.analyze(&p).unwrap();
            let refused = solver.factorize(&v);
            assert_eq!(refused, Err(LinearError::NotFinite { position: 77 }));
            assert_eq!(
                solver.solve_in_place(&mut vec![0.0; p.len()]),
                Err(LinearError::NotFactorized)
            );
        }
    }
}

#[test]
fn a_matrix_near_the_factor_is_solved_without_its_own_where_that_pays() {
    let p = grid([14, 14, 14], 3);
    let b: Vec<f64> = (0..p.len()).map(|i| (i as f64).sin()).collect();
    let first = values(&p, 3, |_| 90.0, false);
    let mut near = first.clone();
    for (i, v) in near.lower.iter_mut().enumerate() {
        *v *= 1.0 + 0.05 * (i as f64).sin();
    }
    let mut far = values(&p, 4, |i| if i % 7 == 0 { 9000.0 } else { 90.0 }, false);
    far.lower[p.col_ptr()[5]] = -90.0;
    let mut solver = DirectSolver::default();
    solver.analyze(&p).unwrap();
    solver.factorize(&first).unwrap();
    for (v, factorisations) in [(&near, [1, 0]), (&far, [2, 1])] {
        solver.renew(v).unwrap();
        let mut x = b.clone();
        solver.solve_in_place(&mut x).unwrap();
        let stats = solver.stats();
        assert_eq!([stats.cholesky, stats.indefinite], factorisations);
        assert!(defect(&p, v, &x, &b) < 1e-7);
    }
    assert!((2..15).contains(&solver.stats().iterations));
    assert!(!solver.is_put_off());
    // Small meshes are factorised at once.
    let p = grid([30, 2, 1], 3);
    let mut solver = DirectSolver::default();
    solver.analyze(&p).unwrap();
    for seed in [1, 2] {
        solver.renew(&values(&p, seed, |_| 90.0, false)).unwrap();
        assert_eq!(solver.stats().cholesky, seed as usize);
    }
}

#[test]
fn a_matrix_is_not_factorised_twice_in_a_row() {
    let p = grid([6, 4, 2], 3);
    let [first, other] = [1, 2].map(|seed| values(&p, seed, |_| 90.0, false));
    let mut solver = DirectSolver::default();
    solver.analyze(&p).unwrap();
    for (v, factorised) in [(&first, 1), (&first, 1), (&other, 2), (&first, 3)] {
        assert_eq!(solver.inertia(v).unwrap().negative, 0);
        assert_eq!(solver.renew(v).unwrap(), Some(Inertia::default()));
        assert_eq!(solver.stats().factorised, factorised);
    }
    solver.factorize(&first).unwrap();
    assert_eq!(solver.stats().factorised, 4);
    // What could not be factorised is no factor at hand.
    let mut singular = first;
    singular.lower.fill(0.0);
    for _ in 0..2 {
        assert!(solver.inertia(&singular).is_err());
    }
}

/// Whether a matrix is regular does not depend on the unit of the forces, nor on that of each unknown: c D A D is what A is, for
/// factors c and diagonals D over many orders of magnitude, symmetric, indefinite or not, also where the diagonal has a zero.
#[test]
fn the_verdict_on_a_matrix_is_that_of_any_scaling() {
    let p = pattern(41);
    let sound = values(&p, 3, |_| 3.0, true);
    let indefinite = values(&p, 3, |j| if j % 3 == 0 { -0.3 } else { 0.2 }, false);
    let mut without_diagonal = sound.clone();
    without_diagonal.lower[p.col_ptr()[20]] = 0.0;
    without_diagonal.upper[p.col_ptr()[20]] = 0.0;
    // Springs between neighbours of each group, held nowhere; a constant has no energy.
    let mut loose = MatrixValues {
        lower: vec![-1.0; p.nnz()],
        upper: vec![-1.0; p.nnz()],
    };
    let mut sums = vec![0.0; p.len()];
    for j in 0..p.len() {
        for k in p.column(j).skip(1) {
            sums[j] += 1.0;
            sums[p.row_idx()[k]] += 1.0;
        }
    }
    for (j, sum) in sums.into_iter().enumerate() {
        loose.lower[p.col_ptr()[j]] = sum;
        loose.upper[p.col_ptr()[j]] = sum;
    }
    let mut loose_symmetric = loose.clone();
    loose_symmetric.upper.clear();
    for (matrix, regular) in [
        (&sound, true),
        (&without_diagonal, true),
        (&loose, false),
        (&indefinite, true),
        (&loose_symmetric, false),
    ] {
        for factor in [1.0, 1e-30, 1e30, 3e-200, 7e150] {
            for orders in [0.0, 3.0, 8.0] {
                let scale = |i: usize| 10_f64.powf(orders * (1.3 * i as f64).sin());
                let mut scaled = matrix.clone();
                for j in 0..p.len() {
                    for k in p.column(j) {
                        let both = factor * scale(j) * scale(p.row_idx()[k]);
                        scaled.lower[k] *= both;
                        if let Some(upper) = scaled.upper.get_mut(k) {
                            *upper *= both;
                        }
                    }
                }
                let mut solver = DirectSolver::default();
                solver.analyze(&p).unwrap();
                let verdict = solver.factorize(&scaled);
                assert_eq!(verdict.is_ok(), regular, "{factor:e} {orders}: {verdict:?}");
            }
        }
    }
}

/// A chain in fronts of one or two equations, tridiagonal, with the given diagonal and ones beside it.
fn chain(diagonal: &[f64], unsymmetric: bool) -> (Sparsity, MatrixValues) {
    let n = diagonal.len() as u32;
    let groups: Vec<Vec<u32>> = (0..n - 1).map(|i| vec![i, i + 1]).collect();
    let p = Sparsity::from_groups(n as usize, groups.iter().map(Vec::as_slice));
    let mut lower = vec![1.0; p.nnz()];
    for (&k, d) in p.col_ptr().iter().zip(diagonal) {
        lower[k] = *d;
    }
    let upper = if unsymmetric {
        lower.clone()
    } else {
        Vec::new()
    };
    (p, MatrixValues { lower, upper })
}

/// Zeros on the diagonal that leave no pivot in their front: of multipliers between springs, first or last in the order, and
/// of a chain of nothing but zeros, which is regular with an even number of equations and singular with an odd one. Source:
/// dense eigenvalues.
#[test]
fn zeros_on_the_diagonal_are_served() {
    let multipliers = |first: usize| -> Vec<f64> {
        let zero = |i: usize| i % 2 == first;
        (0..12).map(|i| if zero(i) { 0.0 } else { 2.0 }).collect()
    };
    let diagonals = [multipliers(0), multipliers(1), vec![0.0; 12], vec![0.0; 11]];
    for (diagonal, regular) in diagonals.iter().zip([true, true, true, false]) {
        for unsymmetric in [false, true] {
            let (p, v) = chain(diagonal, unsymmetric);
            let b: Vec<f64> = (0..p.len()).map(|i| 1.0 + (i as f64).sin()).collect();
            let mut solver = DirectSolver::default();
            solver.analyze(&p).unwrap();
            let inertia = solver.factorize(&v);
            assert_eq!(inertia.is_ok(), regular, "{diagonal:?}: {inertia:?}");
            let Ok(inertia) = inertia else { continue };
            let eigenvalues = dense(&p, &v).symmetric_eigenvalues();
            let negative = eigenvalues.iter().filter(|w| **w < 0.0).count();
            assert_eq!(inertia.negative, if unsymmetric { 0 } else { negative });
            let mut x = b.clone();
            solver.solve_in_place(&mut x).unwrap();
            let defect = defect(&p, &v, &x, &b);
            assert!(defect < 1e-13, "{diagonal:?}: {defect}");
        }
    }
}

/// One constraint given by two multipliers leaves a matrix singular whose last pivot is rounding beside a zero.
#[test]
fn a_constraint_given_twice_is_singular() {
    let all: Vec<u32> = (0..6).collect();
    let p = Sparsity::from_groups(6, std::iter::once(all.as_slice()));
    for seed in 0..200 {
        for unsymmetric in [false, true] {
            let mut v = values(&p, seed, |j| if j < 4 { 3.0 } else { 0.0 }, false);
            for j in 0..4 {
                v.lower[p.position(5, j).unwrap()] = v.lower[p.position(4, j).unwrap()];
            }
            v.lower[p.position(5, 4).unwrap()] = 0.0;
            if unsymmetric {
                v.upper = v.lower.clone();
            }
            let mut solver = DirectSolver::default();
            solver.analyze(&p).unwrap();
            let refused = solver.factorize(&v);
            assert!(
                matches!(refused, Err(LinearError::Singular { .. })),
                "{seed}: {refused:?}"
            );
        }
    }
}
