//! Random paths with loading, unloading and reversals.

use super::random::Random;

/// Between two turning points lie fewer steps than this.
const LONGEST_LEG: f64 = 8.0;

/// A polyline through random turning points inside the box |x_i| <= a_i, walked in random steps.
///
/// A turning point is drawn afresh in the box (some components nearly held), or lies on the way back to the
/// origin (unloading), or on the other side of it (reversal). From the origin itself the last two lead
/// nowhere: two paths in five begin with a leg of no length, which shows whether a law bears repeated updates
/// of the virgin state.
#[derive(Debug)]
pub(super) struct RandomPath {
    random: Random,
    amplitude: Vec<f64>,
    x: Vec<f64>,
    leg: Vec<f64>,
    left: usize,
}

impl RandomPath {
    /// A path from the origin in `n` components; a list of fewer amplitudes is repeated.
    pub(super) fn new(seed: u64, path: usize, amplitude: &[f64], n: usize) -> Self {
        let mut random = Random::new(seed.wrapping_add((path as u64) << 32));
        // Small and large paths alike: the elastic range must be met as well as the far one.
        let size = 10.0_f64.powf(random.uniform(-1.0, 0.0));
        Self {
            random,
            amplitude: (0..n)
                .map(|i| size * amplitude[i % amplitude.len()])
                .collect(),
            x: vec![0.0; n],
            leg: vec![0.0; n],
            left: 0,
        }
    }

    /// Walks one step and returns where it leads.
    pub(super) fn step(&mut self) -> &[f64] {
        if self.left == 0 {
            self.turn();
        }
        self.left -= 1;
        for (x, d) in self.x.iter_mut().zip(&self.leg) {
            *x += d;
        }
        &self.x
    }

    fn turn(&mut self) {
        let random = &mut self.random;
        self.left = random.uniform(1.0, LONGEST_LEG) as usize;
        let kind = random.uniform(0.0, 1.0);
        for ((leg, &x), &a) in self.leg.iter_mut().zip(&self.x).zip(&self.amplitude) {
            let target = if kind < 0.2 {
                x * random.uniform(0.0, 0.5)
            } else if kind < 0.4 {
                -x * random.uniform(0.2, 1.0)
            } else if random.chance(0.3) {
                // Nearly held: exactly held would sit on the kink between loading and unloading.
                x * random.uniform(0.98, 1.0)
            } else {
                random.uniform(-a, a)
            };
            *leg = (target - x) / self.left as f64;
        }
    }
}

#[cfg(test)]
mod tests {
    //! Protects what the checks rely on: paths that stay in the box, turn, and can be repeated.
    use super::*;

    #[test]
    fn a_path_stays_in_its_box_turns_and_repeats() {
        let walk = |path| {
            let mut p = RandomPath::new(7, path, &[1.0, 2.0], 3);
            (0..200).map(|_| p.step().to_vec()).collect::<Vec<_>>()
        };
        let first = walk(0);
        assert_eq!(first, walk(0));
        assert_ne!(first, walk(1));
        assert!(
            first
                .iter()
                .all(|x| x[0].abs() <= 1.0 && x[1].abs() <= 2.0 && x[2].abs() <= 1.0)
        );
        let turns = first
            .windows(3)
            .filter(|w| (w[1][0] - w[0][0]) * (w[2][0] - w[1][0]) < 0.0)
            .count();
        assert!(turns > 20, "{turns}");
    }
}
