//! Communication within the pixel quads of a device.
//!
//! Shaders whose lanes communicate depend on behaviour that graphics interfaces leave unspecified: the position of quads,
//! the execution of all four lanes, and, for derivatives, the use of both rows and both columns of a quad.
//! [`Quads::detect`] draws a few pixels to test these.

use crate::Error;
use crate::guard::run_guarded;
use wgpu::{Device, Features, Queue};

/// Transport of messages between the lanes of a quad; see the generator's option of the same name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum QuadTransport {
    /// By quad operations of subgroups.
    Subgroup,
    /// By fine derivatives.
    Derivatives,
}

/// Derivatives that the probe of quads uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DerivativeControl {
    /// `dpdxFine` and `dpdyFine`, as in emitted shaders.
    #[default]
    Fine,
    /// `dpdxCoarse` and `dpdyCoarse`: the behaviour of a driver without fine derivatives.
    Coarse,
}

/// Precision of derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DerivativeKind {
    /// Each row and each column of a quad has its own: messages arrive.
    Fine,
    /// Both rows of a quad share the derivative of one row, both columns that of one column.
    Coarse,
    /// Fine on one axis, coarse on the other.
    Mixed,
}

/// Messages that arrived, by the sending lane (upper left, upper right, lower left, lower right), then horizontal, vertical and
/// diagonal. A message counts as arrived if all pixels that should receive it did and no other pixel did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arrivals(pub [[bool; 3]; 4]);

impl Arrivals {
    const NAMES: [&str; 3] = ["horizontal", "vertical", "diagonal"];

    /// Returns whether every message arrived.
    pub fn all_arrived(&self) -> bool {
        self.0.iter().flatten().all(|arrived| *arrived)
    }

    /// Lists the lost messages in words; empty if all arrived.
    pub fn lost(&self) -> String {
        if self.0.iter().flatten().all(|arrived| !arrived) {
            return "all of every lane".to_owned();
        }
        let lost = self.0.iter().enumerate().flat_map(|(lane, messages)| {
            let lost = messages.iter().zip(Self::NAMES).filter(|(arrived, _)| !**arrived);
            lost.map(move |(_, name)| format!("{name} from lane {lane}"))
        });
        lost.collect::<Vec<_>>().join(", ")
    }

    fn axis_arrived(&self, message: usize) -> bool {
        self.0.iter().all(|lane| lane[message])
    }
}

/// Result of probing the pixel quads of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quads {
    /// Messages by quad operations; `None` if the device was made without the feature `SUBGROUP`.
    pub subgroup: Option<Arrivals>,
    /// Messages by derivatives.
    pub derivatives: Arrivals,
    /// Precision of the device's derivatives.
    pub kind: DerivativeKind,
    /// Alignment of quads: the lowest bits of the coordinates of their upper left pixels. `None` if pixels disagree.
    pub origin: Option<[u32; 2]>,
    /// True if quads that stick out of a target of an odd size answer as all others do.
    pub odd_sizes: bool,
}

/// An odd size, with whole quads inside and parts of them at two borders.
const SIZE: [u32; 2] = [7, 5];

impl Quads {
    /// Draws a few pixels and reads them back. Takes a moment and waits for the device: do it once, and keep the answer.
    ///
    /// # Errors
    ///
    /// [`Error::Pipeline`] if the device cannot draw them, [`Error::OutOfMemory`], [`Error::DeviceLost`].
    pub fn detect(device: &Device, queue: &Queue) -> Result<Quads, Error> {
        Quads::detect_with(device, queue, DerivativeControl::Fine)
    }

    /// [`detect`](Self::detect) with other derivatives than those of emitted shaders.
    ///
    /// # Errors
    ///
    /// Those of [`detect`](Self::detect).
    pub fn detect_with(device: &Device, queue: &Queue, control: DerivativeControl) -> Result<Quads, Error> {
        let subgroups = device.features().contains(Features::SUBGROUP);
        let text = probe_text(subgroups, control);
        let refused = |description| Error::Pipeline {
            kernel: PROBE.to_owned(),
            description,
        };
        let bytes = run_guarded(device, "looking at pixel quads", refused, || {
            draw_probe(device, queue, &text)
        })?;
        let bytes = bytes.ok_or_else(|| Error::DeviceLost {
            doing: "looking at pixel quads".to_owned(),
        })?;
        Ok(judge_pixels(&bytes, subgroups))
    }

    /// Returns the transport to use: quad operations if they work, else fine derivatives.
    ///
    /// # Errors
    ///
    /// The reason why there is none, and the remedy.
    pub fn choose(&self) -> Result<QuadTransport, String> {
        let place = match self.origin {
            None => Err("pixels do not agree on where their quads begin".to_owned()),
            Some([0, 0]) => Ok(()),
            Some([x, y]) => Err(format!("quads begin at pixels of parity ({x}, {y}), not at even ones")),
        };
        let odd = match self.odd_sizes {
            true => Ok(()),
            false => Err("quads that stick out of a target of an odd size answer otherwise".to_owned()),
        };
        let ground = place.and(odd);
        if ground.is_ok() && self.subgroup.is_some_and(|arrivals| arrivals.all_arrived()) {
            return Ok(QuadTransport::Subgroup);
        }
        if ground.is_ok() && self.kind == DerivativeKind::Fine && self.derivatives.all_arrived() {
            return Ok(QuadTransport::Derivatives);
        }
        let mut reasons = Vec::new();
        reasons.extend(ground.err());
        match self.subgroup {
            None => reasons.push("the device was created without the feature SUBGROUP".to_owned()),
            Some(arrivals) if !arrivals.all_arrived() => {
                reasons.push(format!(
                    "of messages by quad operations these get lost: {}",
                    arrivals.lost()
                ));
            }
            Some(_) => {}
        }
        if self.kind != DerivativeKind::Fine || !self.derivatives.all_arrived() {
            let kind = match self.kind {
                DerivativeKind::Fine => "fine",
                DerivativeKind::Coarse => "coarse",
                DerivativeKind::Mixed => "fine on one axis only",
            };
            reasons.push(format!(
                "derivatives are {kind}, and of messages by them these get lost: {}",
                self.derivatives.lost()
            ));
        }
        Err(format!(
            "pixel quads cannot send messages here: {}; generate the shader for compute, with the transport `block`",
            reasons.join("; ")
        ))
    }
}

const PROBE: &str = "quad probe";

/// The probe's text: for each lane in turn, a value that it alone has, sent three ways by each transport.
fn probe_text(subgroups: bool, control: DerivativeControl) -> String {
    let mut answers = String::new();
    for hot in 0..4 {
        answers += &format!("    let hot{hot} = select(0.0, 4.0, lane == {hot}u);\n");
        answers += &format!("    let below{hot} = hot{hot} + towards.y * dpdyCONTROL(hot{hot});\n");
        let derivatives = [
            format!("hot{hot} + towards.x * dpdxCONTROL(hot{hot})"),
            format!("below{hot}"),
            format!("below{hot} + towards.x * dpdxCONTROL(below{hot})"),
        ];
        let subgroup = [
            format!("quadSwapX(hot{hot})"),
            format!("quadSwapY(hot{hot})"),
            format!("quadSwapDiagonal(hot{hot})"),
        ];
        let ways = [("derivatives", derivatives, true), ("subgroup", subgroup, subgroups)];
        for (name, messages, there) in ways {
            for (m, message) in messages.iter().enumerate().filter(|_| there) {
                let (bit, direction) = (hot * 3 + m, m + 1);
                answers += &format!(
                    "    {name} |= select(0u, {}u, arrived({message}, lane, {direction}u, {hot}u));\n",
                    1u32 << bit
                );
            }
        }
    }
    let control = match control {
        DerivativeControl::Fine => "Fine",
        DerivativeControl::Coarse => "Coarse",
    };
    include_str!("probe.wgsl")
        .replace("ANSWERS\n", &answers)
        .replace("CONTROL", control)
}

/// Draws the probe and reads it back; `None` if the device is lost meanwhile.
fn draw_probe(device: &Device, queue: &Queue, text: &str) -> Option<Vec<u8>> {
    let label = Some(PROBE);
    let format = wgpu::TextureFormat::Rgba32Uint;
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label,
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor::default());
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label,
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("cover"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("probe"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    let target = device.create_texture(&wgpu::TextureDescriptor {
        label,
        size: wgpu::Extent3d {
            width: SIZE[0],
            height: SIZE[1],
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label,
        size: u64::from(ROW * SIZE[1]),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label,
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        })],
        depth_stencil_attachment: None,
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    pass.set_pipeline(&pipeline);
    pass.draw(0..3, 0..1);
    drop(pass);
    let copy = wgpu::TexelCopyBufferInfo {
        buffer: &buffer,
        layout: wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(ROW),
            rows_per_image: None,
        },
    };
    encoder.copy_texture_to_buffer(target.as_image_copy(), copy, target.size());
    queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |_| {});
    device.poll(wgpu::PollType::wait_indefinitely()).ok()?;
    let bytes = buffer.get_mapped_range(..).ok()?.to_vec();
    Some(bytes)
}

/// Bytes of a row as buffers have it.
const ROW: u32 = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;

/// Evaluates the pixels of the probe.
fn judge_pixels(bytes: &[u8], subgroups: bool) -> Quads {
    let word = |x: u32, y: u32, k: u32| {
        let at = (y * ROW + x * 16 + k * 4) as usize;
        u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
    };
    let pixels = || (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
    let whole = |(x, y): &(u32, u32)| *x < SIZE[0] / 2 * 2 && *y < SIZE[1] / 2 * 2;
    let all = |k: u32, inside: bool| {
        let some = pixels().filter(|at| whole(at) || !inside);
        some.fold(u32::MAX, |bits, (x, y)| bits & word(x, y, k))
    };
    let arrivals = |bits: u32| {
        Arrivals(std::array::from_fn(|lane| {
            std::array::from_fn(|m| bits >> (lane * 3 + m) & 1 == 1)
        }))
    };
    let parity = |axis: u32| {
        let own = |(x, y): (u32, u32)| if axis == 0 { x } else { y };
        let lowest = pixels().map(|at| word(at.0, at.1, 2 + axis));
        let mut parities = lowest.clone().map(|first| first & 1);
        let first = parities.next().unwrap_or(0);
        // Each pixel belongs to the quad that it says it does.
        let belongs = pixels()
            .zip(lowest)
            .all(|(at, first)| own(at) == first || own(at) == first.wrapping_add(1));
        (belongs && parities.all(|p| p == first)).then_some(first)
    };
    let derivatives = arrivals(all(0, true));
    let kind = match (derivatives.axis_arrived(0), derivatives.axis_arrived(1)) {
        (true, true) => DerivativeKind::Fine,
        (false, false) => DerivativeKind::Coarse,
        _ => DerivativeKind::Mixed,
    };
    Quads {
        subgroup: subgroups.then(|| arrivals(all(1, true))),
        derivatives,
        kind,
        origin: parity(0).zip(parity(1)).map(|(x, y)| [x, y]),
        odd_sizes: all(0, true) == all(0, false) && all(1, true) == all(1, false),
    }
}

#[cfg(test)]
mod tests;
