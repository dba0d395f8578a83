//! A shader of the gallery, and every check of it.

use crate::common::forms::{Example, first, image, pixels, save, texture};
use crate::gallery::world::World;
use glam::DVec4;
use straightline_bench::execute::{Inputs, test_inputs};
use straightline_codegen::Settings;
use straightline_kernels::prelude::*;

/// A shader with its inputs.
pub struct Shader {
    pub example: Example,
    pub inputs: Inputs,
}

/// Largest error, and the share of the pixels that may exceed it, since a decision hangs on the last bit.
#[derive(Clone, Copy)]
pub struct Within(pub f64, pub f64);

impl Shader {
    pub fn new(name: &'static str, size: UVec2) -> Shader {
        let example = Example::new("examples/gallery", name);
        let inputs = test_inputs(&example.compile(&Settings::default()).graph, size);
        Shader { example, inputs }
    }

    pub fn number(mut self, name: &str, value: f64) -> Shader {
        self.inputs = self.inputs.with_uniform(name, &[value]);
        self
    }

    pub fn vector(mut self, name: &str, value: &[f64]) -> Shader {
        self.inputs = self.inputs.with_uniform(name, value);
        self
    }

    /// With another image, of a place in 0 to 1.
    pub fn image(mut self, name: &str, texel: impl Fn(Vec2) -> Vec4) -> Shader {
        let given = self.inputs.images.iter_mut().find(|(n, _)| n == name);
        let (_, layers) = given.expect("an image of this name");
        let size = layers[0].size();
        let texels = pixels(size).map(|at| texel((at.as_vec2() + 0.5) / size.as_vec2()));
        layers[0] = Frame::new(size, texels.collect());
        self
    }

    pub fn float(&self, name: &str) -> f32 {
        self.components(name)[0]
    }

    pub fn components(&self, name: &str) -> Vec<f32> {
        let numbers = self.inputs.uniforms.iter().rev().find(|(n, _)| n == name);
        numbers.expect("a uniform").1.iter().map(|v| *v as f32).collect()
    }

    pub fn frame(&self, name: &str) -> &Frame<Vec4> {
        image(&self.inputs, name)
    }

    pub fn texture(&self, name: &str) -> Texture<Vec4> {
        texture(&self.inputs, name)
    }

    pub fn flat(&self, name: &str) -> Frame<f32> {
        first(&self.inputs, name, Frame::new)
    }

    pub fn pairs(&self, name: &str) -> Frame<Vec2> {
        let image = self.frame(name);
        Frame::new(image.size(), image.texels().iter().map(|t| t.xy()).collect())
    }

    pub fn normals(&self, name: &str) -> Frame<Vec3> {
        let image = self.frame(name);
        Frame::new(image.size(), image.texels().iter().map(|t| t.truncate()).collect())
    }

    /// Every check of a shader. `native` is the kernel as rustc has compiled it.
    pub fn check(
        &self,
        gpu: Within,
        by_definition: Within,
        native: impl Fn(IVec2) -> Vec4,
        oracle: impl Fn(&World, i64, i64) -> DVec4,
    ) {
        let name = self.example.name;
        let world = World(&self.inputs);
        let (mut off, mut worst) = (0, 0.0f64);
        for at in pixels(self.inputs.size) {
            let expected = oracle(&world, at.x.into(), at.y.into());
            let found = native(at).as_dvec4();
            let error = (found - expected).abs().max_element();
            worst = worst.max(error);
            assert!(found.is_finite(), "{name} is {found} at {at}");
            off += usize::from(error > by_definition.0);
        }
        let share = off as f64 / f64::from(self.inputs.size.element_product());
        assert!(
            share <= by_definition.1,
            "{name}: {off} pixels, a share of {share:.4}, are off by more than {} of their definition, by at most {worst}",
            by_definition.0
        );
        println!(
            "{name}: a share of {share:.4} is off by more than {}, by at most {worst:.2e}",
            by_definition.0
        );
        let shown = self.example.check(&self.inputs, gpu.0 as f32, gpu.1, native);
        save(name, &self.inputs, &shown);
    }
}
