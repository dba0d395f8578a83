//! Verdicts on results that no available device produces.

use super::*;

/// The answers of a device whose derivatives are of the given kind and whose quads begin at a parity.
fn probe_answers(fine: [bool; 2], origin: [u32; 2]) -> Vec<u8> {
    let mut bytes = vec![0; (ROW * SIZE[1]) as usize];
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            // The quad's first pixel; beyond the target's border it may be at -1.
            let corner = [x, y].map(i64::from);
            let corner = [0, 1].map(|a| corner[a] - (corner[a] + i64::from(origin[a])).rem_euclid(2));
            let lane = |at: [i64; 2]| (at[0].rem_euclid(2) + 2 * at[1].rem_euclid(2)) as u32;
            let pixel = [i64::from(x), i64::from(y)];
            let mut bits = 0;
            for hot in 0..4u32 {
                let value = |at: [i64; 2]| if lane(at) == hot { 4.0 } else { 0.0 };
                let slope = |axis: usize, of: &dyn Fn([i64; 2]) -> f32, at: [i64; 2]| {
                    let mut from = at;
                    from[axis] = corner[axis];
                    if !fine[axis] {
                        from[1 - axis] = corner[1 - axis];
                    }
                    let mut to = from;
                    to[axis] += 1;
                    of(to) - of(from)
                };
                let towards = |axis: usize, at: [i64; 2]| 1.0 - 2.0 * (at[axis].rem_euclid(2)) as f32;
                let beside = |at: [i64; 2]| value(at) + towards(0, at) * slope(0, &value, at);
                let below = |at: [i64; 2]| value(at) + towards(1, at) * slope(1, &value, at);
                let across = |at: [i64; 2]| below(at) + towards(0, at) * slope(0, &below, at);
                for (m, heard) in [beside(pixel), below(pixel), across(pixel)].into_iter().enumerate() {
                    let expected = if lane(pixel) ^ (m as u32 + 1) == hot { 4.0 } else { 0.0 };
                    bits |= u32::from(heard == expected) << (hot as usize * 3 + m);
                }
            }
            let words = [bits, 0, corner[0] as i32 as u32, corner[1] as i32 as u32];
            let at = (y * ROW + x * 16) as usize;
            for (k, word) in words.into_iter().enumerate() {
                bytes[at + 4 * k..][..4].copy_from_slice(&word.to_le_bytes());
            }
        }
    }
    bytes
}

#[test]
fn kinds_of_derivatives_are_told_apart() {
    for (fine, kind) in [
        ([true, true], DerivativeKind::Fine),
        ([false, false], DerivativeKind::Coarse),
        ([false, true], DerivativeKind::Mixed),
        ([true, false], DerivativeKind::Mixed),
    ] {
        let quads = judge_pixels(&probe_answers(fine, [0, 0]), false);
        assert_eq!((quads.kind, quads.origin, quads.odd_sizes), (kind, Some([0, 0]), true));
        assert_eq!(
            quads.derivatives.all_arrived(),
            kind == DerivativeKind::Fine,
            "{fine:?}: {}",
            quads.derivatives.lost()
        );
        match quads.choose() {
            Ok(transport) => assert_eq!((transport, kind), (QuadTransport::Derivatives, DerivativeKind::Fine)),
            Err(why) => assert!(why.contains("get lost") && why.contains("`block`"), "{why}"),
        }
    }
}

/// The chapter's test, a mean of a value of one lane, passes here, but each swap on its own fails.
#[test]
fn a_mean_would_not_have_told() {
    let quads = judge_pixels(&probe_answers([false, true], [0, 0]), false);
    assert_eq!(quads.kind, DerivativeKind::Mixed);
    assert!(quads.choose().is_err());
}

#[test]
fn quads_elsewhere_are_refused() {
    for origin in [[1, 0], [0, 1], [1, 1]] {
        let quads = judge_pixels(&probe_answers([true, true], origin), false);
        assert_eq!(quads.origin, Some(origin));
        let why = quads.choose().expect_err("not at even pixels");
        assert!(why.contains("parity"), "{why}");
    }
    let mut mixed = probe_answers([true, true], [0, 0]);
    mixed[8] = 1;
    assert_eq!(judge_pixels(&mixed, false).origin, None);
}

#[test]
fn borders_that_answer_otherwise_are_refused() {
    let mut bytes = probe_answers([true, true], [0, 0]);
    bytes[(SIZE[0] as usize - 1) * 16] = 0;
    let quads = judge_pixels(&bytes, false);
    assert!(quads.derivatives.all_arrived() && !quads.odd_sizes);
    assert!(quads.choose().expect_err("odd sizes").contains("odd size"));
}
