//! Chains that read the result of the frame before.

use crate::chains::run;
use crate::common::chains::{BLEND, color_size, make_of, pass, picture, plan};
use crate::common::{Gpu, STAGES, ramp, view};
use straightline_runtime::BoundChain;

/// `color` and what covers it in `before`, added.
fn sum(size: [u32; 2], color: &[[f32; 4]], before: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let width = size[0] as usize;
    let covering = |k: usize| before[k / width / 2 * width + k % width / 2];
    let texel = |k: usize| [0, 1, 2, 3].map(|c| color[k][c] + covering(k)[c]);
    (0..color.len()).map(texel).collect()
}

#[test]
fn frames_take_turns_with_two_textures() {
    let gpu = Gpu::new();
    let size = [9, 5];
    let color = ramp(size, 1);
    let input = view(&gpu.upload(size, 1, &color));
    let plan = plan(
        &["color", "before"],
        vec![picture("out", &color_size(None), None)],
        vec![pass("blend", &[("color", "color"), ("small", "before")], &["out"])],
    );
    for stage in STAGES {
        let chain = make_of(&gpu, &plan, &[&BLEND], stage).expect("a chain");
        // wgpu clears textures, so the first frame has a history of zeros.
        let textures = [gpu.target(size), gpu.target(size)];
        let views = [0, 1].map(|k| view(&textures[k]));
        let frames: [BoundChain; 2] = [0, 1].map(|k| {
            let inputs = [("color", &input), ("before", &views[1 - k])];
            chain.bind(&inputs, &views[k]).expect("to bind")
        });
        let mut expected = vec![[0.0; 4]; color.len()];
        for frame in 0..5 {
            run(&gpu, &frames[frame % 2]);
            expected = sum(size, &color, &expected);
            assert_eq!(gpu.download(&textures[frame % 2]), expected, "{stage:?}, frame {frame}");
        }
    }
}
