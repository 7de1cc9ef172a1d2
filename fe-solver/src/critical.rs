//! Critical points of a path: where the tangent becomes singular between two accepted steps.
//!
//! With K the symmetric part of the consistent tangent of the free equations and q the load per unit of the load factor,
//! the number of negative pivots of K is that of its negative eigenvalues (Sylvester), and S = q . K^-1 q is the response
//! to the load, the reciprocal of Bergan's (1980) stiffness parameter. Where an eigenvalue mu with mode phi passes zero, S
//! behaves like (q . phi)^2/mu: at a limit point, q . phi not zero, it changes its sign; at a bifurcation, q . phi = 0,
//! it keeps it.

use std::fmt;

/// A kind of critical point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Critical {
    /// The load factor has an extremum; eigenvalues have become negative.
    Limit,
    /// Another path branches off; eigenvalues have become negative.
    Bifurcation,
    /// Eigenvalues have become positive again.
    Regained,
}

impl fmt::Display for Critical {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Limit => "limit point",
            Self::Bifurcation => "bifurcation",
            Self::Regained => "stability regained",
        })
    }
}

/// What is known of the tangent at an accepted state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Signs {
    /// Negative pivots.
    pub negative: usize,
    /// Whether the response S to the load is negative.
    pub turned: bool,
}

impl Signs {
    /// Of a positive-definite tangent.
    pub const STABLE: Self = Self {
        negative: 0,
        turned: false,
    };

    /// What lies between this state and a later one.
    pub fn until(self, later: Self) -> Option<Critical> {
        if later.negative < self.negative {
            Some(Critical::Regained)
        } else if later.negative == self.negative {
            None
        } else if later.turned == self.turned {
            Some(Critical::Bifurcation)
        } else {
            Some(Critical::Limit)
        }
    }
}

#[cfg(test)]
mod tests {
    //! Protects the names of critical points.
    use super::*;

    /// Two springs in parallel, one of them softening and free to tilt: K = diag(k, c), loaded along the first axis by q =
    /// (1, 0). S = 1/k. The sign of k is that of a limit point, the sign of c that of a bifurcation.
    fn signs(k: f64, c: f64) -> Signs {
        Signs {
            negative: usize::from(k < 0.0) + usize::from(c < 0.0),
            turned: 1.0 / k < 0.0,
        }
    }

    #[test]
    fn limit_points_turn_the_response_and_bifurcations_do_not() {
        let virgin = signs(2.0, 1.0);
        assert_eq!(virgin, Signs::STABLE);
        assert_eq!(virgin.until(signs(1.0, 0.5)), None);
        assert_eq!(virgin.until(signs(-0.1, 0.5)), Some(Critical::Limit));
        assert_eq!(virgin.until(signs(1.0, -0.5)), Some(Critical::Bifurcation));
        assert_eq!(
            signs(-0.1, 0.5).until(signs(-0.2, -0.1)),
            Some(Critical::Bifurcation)
        );
        assert_eq!(
            signs(1.0, -0.5).until(signs(-1.0, -0.5)),
            Some(Critical::Limit)
        );
        assert_eq!(signs(-1.0, -0.5).until(virgin), Some(Critical::Regained));
    }
}
