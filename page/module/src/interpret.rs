//! A kernel's picture, computed by the interpreter: what the page shows where there is neither WebGPU nor WebGL2, and what
//! its tests compare with.

use crate::compiled::Asked;
use crate::errors::Refusal;
use crate::inputs::{self, Plane};
use crate::state::State;
use serde::Deserialize;
use serde_json::json;
use std::collections::BTreeMap;
use straightline_codegen::interp::{Bindings, Image, Interpreter};
use straightline_page_abi::Message;

/// Request to compute a picture.
#[derive(Deserialize)]
pub struct InterpretRequest {
    #[serde(flatten)]
    asked: Asked,
    /// Width and height of the result.
    size: [u32; 2],
    /// Values of uniforms.
    #[serde(default)]
    uniforms: BTreeMap<String, Vec<f64>>,
}

/// The picture: four floats a pixel, rows from the top.
pub fn interpret_kernel(state: &mut State, request: &InterpretRequest) -> Result<Message, Refusal> {
    let compiled = state.cached_compiled(&request.asked)?;
    let planes = inputs::fill_planes(state, &request.asked, request.size)?;
    let compiled = &*compiled.in_blocks();
    let images = planes
        .iter()
        .map(|plane| Ok((plane.name.as_str(), plane_image(plane)?)));
    let images = images.collect::<Result<Vec<(&str, Image)>, Refusal>>()?;
    let mut bindings = Bindings::new();
    for (name, image) in &images {
        bindings = bindings.texture(name, image);
    }
    for (name, lanes) in &request.uniforms {
        bindings = bindings.uniform(name, lanes);
    }
    let interpreter = Interpreter::<f32>::new(&compiled.graph, &compiled.schedule, request.size, &bindings)
        .map_err(|why| Refusal::from_message(&why.to_string()))?;
    let [width, height] = request.size.map(|n| n as usize);
    let [across, down] = compiled.graph.invocation.block_size().map(|n| n as usize);
    let mut texels = vec![[0.0_f32; 4]; width * height];
    let mut scratch = interpreter.new_scratch();
    for y in (0..height).step_by(down) {
        for x in (0..width).step_by(across) {
            let computed = interpreter.run_invocation(x as u32, y as u32, &mut scratch);
            for (k, texel) in computed.into_iter().enumerate() {
                let (x, y) = (x + k % across, y + k / across);
                if x < width && y < height {
                    texels[y * width + x] = texel;
                }
            }
        }
    }
    Ok(Message {
        json: json!({ "width": width, "height": height }),
        bytes: texels.iter().flatten().flat_map(|value| value.to_le_bytes()).collect(),
    })
}

fn plane_image(plane: &Plane) -> Result<Image, Refusal> {
    let layers = plane.layers.iter();
    let layers = layers.map(|layer| layer.iter().map(|texel| plane.format.round_texel(*texel)).collect());
    Image::new(plane.size, layers.collect())
        .ok_or_else(|| Refusal::from_message(&format!("the layers of `{}` have different sizes", plane.name)))
}
