//! Path constraints: the equation that borders the system and fixes the load factor.

use std::fmt::Debug;

/// Linearisation of a path constraint g(du, dlambda) = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Border {
    /// Value of g.
    pub value: f64,
    /// Derivative of g with respect to the load factor.
    pub slope: f64,
}

/// One scalar equation g(du, dlambda) = 0 on the increment of a step, with du the free part (mm).
///
/// With K du_r = r and K du_q = q, the correction of the bordered system is
/// d lambda = -(g + c . du_r)/(d + c . du_q), du = du_r + d lambda du_q, where c and d are the
/// derivatives of g.
pub trait PathConstraint: Debug + Send {
    /// Starts a step of the given length.
    fn begin(&mut self, length: f64);

    /// Value and derivatives at the increment so far; writes dg/du into `gradient`, zeroed before.
    fn linearise(&self, du: &[f64], dlambda: f64, gradient: &mut [f64]) -> Border;
}

/// The load factor itself grows by the length of the step: displacement control where the factor
/// drives prescribed displacements, load control where it drives forces. g = dlambda - length.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LoadFactor {
    length: f64,
}

impl PathConstraint for LoadFactor {
    fn begin(&mut self, length: f64) {
        self.length = length;
    }

    fn linearise(&self, _du: &[f64], dlambda: f64, _gradient: &mut [f64]) -> Border {
        Border {
            value: dlambda - self.length,
            slope: 1.0,
        }
    }
}

/// A free displacement grows by the length of the step (mm) while the load factor drives forces.
/// g = du_k - length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeDisplacement {
    equation: usize,
    length: f64,
}

impl FreeDisplacement {
    /// Controls the free equation `equation`.
    pub const fn new(equation: usize) -> Self {
        Self {
            equation,
            length: 0.0,
        }
    }
}

impl PathConstraint for FreeDisplacement {
    fn begin(&mut self, length: f64) {
        self.length = length;
    }

    fn linearise(&self, du: &[f64], _dlambda: f64, gradient: &mut [f64]) -> Border {
        gradient[self.equation] = 1.0;
        Border {
            value: du[self.equation] - self.length,
            slope: 0.0,
        }
    }
}
