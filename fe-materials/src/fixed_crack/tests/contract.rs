//! Protects what every law owes its caller: the same answer for one point and many, refusals, objectivity, tangents, energy.

use fe_core::material::{Material, MaterialError, PointContext};
use fe_core::testing::{MaterialCheck, Worst, check_isotropy, check_material};
use nalgebra::Vector6;

use super::{WIDTH, build, law, parameters};
use crate::fixed_crack::{
    CompressionSoftening, Confinement, FIXING_SHARE, FixedCrack, FixedCrackParameters,
    ShearTransfer, TensionSoftening,
};

/// Points answered together are answered as one by one, to the last bit, cracked or not; the first that fails is named.
#[test]
fn many_points_are_answered_as_one_by_one() {
    let law = law(0.2);
    let (n, count) = (law.state_len(), 60);
    let strain =
        |p: usize, size: f64| Vector6::from_fn(|k, _| size * ((7 * p + 3 * k) as f64).sin());
    let ctx = PointContext::new(WIDTH);
    let mut states = vec![0.0; n * count];
    for (p, own) in states.chunks_exact_mut(n).enumerate() {
        law.init_state(own);
        if p % 3 == 0 {
            let virgin = own.to_vec();
            law.update(&strain(p, 1e-3), &virgin, own, &ctx).unwrap();
        }
    }
    let mut strains: Vec<_> = (0..count).map(|p| strain(p + 1, 3e-4)).collect();
    let mut trial = states.clone();
    let mut seen = 0;
    law.update_many(&strains, (&states, &mut trial), &ctx, &mut |p, found| {
        let mut own = vec![0.0; n];
        let state = &states[p * n..(p + 1) * n];
        let expected = law.update(&strains[p], state, &mut own, &ctx).unwrap();
        assert_eq!(*found, expected, "{p}");
        seen += 1;
    })
    .unwrap();
    assert_eq!(seen, count);
    strains[41][2] = f64::NAN;
    let failed = law.update_many(&strains, (&states, &mut trial), &ctx, &mut |_, _| {});
    assert_eq!(failed.unwrap_err().0, 41);
}

/// Impossible input is an error that names parameter and remedy, before anything runs.
#[test]
fn impossible_parameters_and_bands_are_refused() {
    let bad = [
        FixedCrackParameters {
            ft_mpa: -1.0,
            ..parameters()
        },
        FixedCrackParameters {
            poisson: 0.5,
            ..parameters()
        },
        FixedCrackParameters {
            eps_c1: 1e-4,
            ..parameters()
        },
        FixedCrackParameters {
            ft_mpa: parameters().fcm_mpa,
            ..parameters()
        },
        FixedCrackParameters {
            shear_transfer: ShearTransfer::Interlock { aggregate_mm: 0.0 },
            ..parameters()
        },
    ];
    for p in bad {
        let error = FixedCrack::new(p, None).unwrap_err();
        assert!(matches!(error, MaterialError::Parameter { .. }), "{error}");
    }
    for band_width in [f64::NAN, 0.0, -1.0] {
        let refused = law(0.2).admit(&PointContext::new(band_width));
        assert!(matches!(
            refused,
            Err(MaterialError::Parameter {
                parameter: "band_width",
                ..
            })
        ));
    }
    for relaxation in [f64::NAN, -0.1, 1.1] {
        let ctx = PointContext {
            relaxation,
            ..PointContext::new(50.0)
        };
        let refused = law(0.2).admit(&ctx).unwrap_err();
        assert!(refused.to_string().contains("relaxation"), "{refused}");
    }
    let limit = match law(0.2).admit(&PointContext::new(1e4)) {
        Err(MaterialError::BandTooWide { limit, .. }) => limit,
        other => panic!("{other:?}"),
    };
    assert!(law(0.2).admit(&PointContext::new(0.999 * limit)).is_ok());
    assert!(law(0.2).admit(&PointContext::new(1.001 * limit)).is_err());
}

/// Benchmark MAT-04: the same in rotated axes, sound, with axes that follow and with fixed ones, on 15 000 random paths. Target:
/// 2e-14 of the largest stress.
#[test]
fn isotropic() {
    let mut worst = Worst::new(
        "MAT-04: cracking law, anisotropy over the largest stress",
        2e-14,
    );
    for fixing_share in [FIXING_SHARE, 1.0] {
        for amplitude in [1e-4, 1e-3, 1e-2] {
            let p = FixedCrackParameters {
                fixing_share,
                ..parameters()
            };
            let check = MaterialCheck {
                paths: 2500,
                steps: 10,
                ..MaterialCheck::new(amplitude)
            };
            let report = check_isotropy(&build(p), &check).unwrap();
            worst.see(report.worst, (fixing_share, amplitude));
        }
    }
    worst.tell();
}

/// Benchmark MAT-04, contract of a law on 10^4 random paths and more: repeatable, latched, tangent to 1e-6, secant positive definite,
/// and no energy created once cracked.
#[test]
fn conforms() {
    let plain = FixedCrackParameters {
        poisson: 0.0,
        tension_softening: TensionSoftening::Linear,
        shear_transfer: ShearTransfer::Damage,
        compression_softening: CompressionSoftening::None,
        ..parameters()
    };
    let confined = |p| FixedCrackParameters {
        confinement: Confinement::Vecchio,
        ..p
    };
    let fixing = |fixing_share| FixedCrackParameters {
        fixing_share,
        ..parameters()
    };
    let mut tangent = Worst::new("MAT-04: cracking law, tangent against differences", 1e-6);
    let mut drift = Worst::new("MAT-04: cracking law, change by a zero increment", 1e-10);
    let mut created = Worst::new("MAT-04: cracking law, energy created (N mm/mm3)", 1e-12);
    for p in [
        parameters(),
        plain,
        fixing(0.3),
        fixing(1.0),
        confined(parameters()),
        confined(plain),
    ] {
        for amplitude in [1e-3, 1e-2] {
            let check = MaterialCheck {
                paths: 2500,
                steps: 10,
                ..MaterialCheck::new(amplitude)
            };
            let report = check_material(&build(p), &check).unwrap();
            tangent.see(report.worst_tangent, amplitude);
            drift.see(report.worst_drift, amplitude);
            created.see((-report.least_dissipation.unwrap()).max(0.0), amplitude);
        }
    }
    tangent.tell();
    drift.tell();
    created.tell();
}

/// With histories that lag behind, as under viscosity: tangent against differences to 1e-6, whatever share of its growth a history
/// takes up, and the answer of a frozen one.
#[test]
fn conforms_with_histories_that_lag() {
    let mut tangent = Worst::new("cracking law that lags, tangent against differences", 1e-6);
    for relaxation in [0.0, 0.3, 0.7] {
        for amplitude in [1e-3, 1e-2] {
            let check = MaterialCheck {
                paths: 500,
                steps: 10,
                context: PointContext {
                    relaxation,
                    ..MaterialCheck::new(amplitude).context
                },
                // Such a history still grows in a step without increment.
                drift_tolerance: 1.0,
                ..MaterialCheck::new(amplitude)
            };
            let report = check_material(&build(parameters()), &check).unwrap();
            tangent.see(report.worst_tangent, (relaxation, amplitude));
        }
    }
    tangent.tell();
}
