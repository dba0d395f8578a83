//! Pixel quads of the adapter at hand.

use crate::common;

use common::Gpu;
use straightline_runtime::wgpu::Features;
use straightline_runtime::{DerivativeControl, DerivativeKind, QuadTransport, Quads};

/// Software drivers, and every GPU known to us, lay quads at even pixels and have fine derivatives.
#[test]
fn messages_arrive() {
    let plain = Gpu::new();
    let quads = Quads::detect(&plain.device, &plain.queue).expect("pixels are drawn");
    println!("{quads:#?}");
    assert_eq!(quads.origin, Some([0, 0]));
    assert_eq!(quads.kind, DerivativeKind::Fine);
    assert!(quads.odd_sizes && quads.derivatives.all_arrived());
    assert_eq!(quads.subgroup, None);
    assert_eq!(quads.choose(), Ok(QuadTransport::Derivatives));
    let subgroups = Gpu::with(Features::SUBGROUP, Default::default());
    let quads = Quads::detect(&subgroups.device, &subgroups.queue).expect("pixels are drawn");
    assert_eq!(quads.choose(), Ok(QuadTransport::Subgroup));
}

/// A driver may give fine derivatives where coarse ones are asked for (lavapipe does), or truly coarse ones (SwiftShader):
/// those are seen, and without subgroups refused.
#[test]
fn coarse_derivatives_are_seen() {
    let gpu = Gpu::new();
    let quads = Quads::detect_with(&gpu.device, &gpu.queue, DerivativeControl::Coarse).expect("pixels are drawn");
    println!("{:?}: {:?}", quads.kind, quads.choose());
    match quads.kind {
        DerivativeKind::Fine => assert_eq!(quads.choose(), Ok(QuadTransport::Derivatives)),
        _ => {
            assert!(!quads.derivatives.all_arrived());
            let why = quads.choose().expect_err("no transport is left");
            assert!(
                why.contains("coarse") && why.contains("of every lane") && why.contains("`block`"),
                "{why}"
            );
        }
    }
}
