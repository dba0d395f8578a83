//! The kernels that come with the page: the built-in ones, and those of `examples/` that read pictures.

use crate::errors::Refusal;
use serde_json::{Value, json};
use straightline_codegen::spec::{Arity, KNOBS, Part};
use straightline_codegen::{Kernel, ShaderSpec};

/// A kernel of the page.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Name in the catalogue: that of a built-in kernel, or folder and name of an example.
    pub id: &'static str,
    /// Purpose, the heading of its group in the list.
    pub group: &'static str,
    /// Path and text of an example.
    pub example: Option<(&'static str, &'static str)>,
    /// Values to begin with of numbers that are set at run time and have no default.
    pub uniforms: &'static [UniformRange],
    /// Width of the result over that of the picture.
    pub scale: u32,
    /// Loop policy unless the visitor chooses another: long marches keep their loops.
    pub unroll: &'static str,
}

/// A number that is set at run time.
#[derive(Clone, Copy, Debug)]
pub struct UniformRange {
    /// Name in the kernel.
    pub name: &'static str,
    /// Initial value, component by component.
    pub value: &'static [f64],
    /// The least that its control offers.
    pub min: f64,
    /// The most.
    pub max: f64,
}

const fn number(name: &'static str, value: &'static [f64], min: f64, max: f64) -> UniformRange {
    UniformRange { name, value, min, max }
}

/// Folder in the repository of a folder of the page.
macro_rules! folder {
    ("kernels") => {
        "kernels/filters"
    };
    ("gallery") => {
        "examples/gallery"
    };
}

macro_rules! example {
    ($group:literal, $folder:tt, $name:literal $(; scale $scale:literal)? $(; unroll $unroll:literal)? $(, $($uniform:expr),+)?) => {
        Entry {
            id: concat!($folder, "/", $name),
            group: $group,
            example: Some((
                concat!(folder!($folder), "/", $name, ".rs"),
                include_str!(concat!("../../../", folder!($folder), "/", $name, ".rs")),
            )),
            uniforms: &[$($($uniform),+)?],
            scale: 1 $( * $scale)?,
            unroll: [$($unroll,)? "full"][0],
        }
    };
}

const fn builtin_entry(group: &'static str, id: &'static str) -> Entry {
    Entry {
        id,
        group,
        example: None,
        uniforms: &[],
        scale: 1,
        unroll: "full",
    }
}

/// Every kernel of the page, in the order of its list.
pub const ENTRIES: &[Entry] = &[
    builtin_entry("Antialiasing", "sraa"),
    builtin_entry("Antialiasing", "sraa_place"),
    builtin_entry("Antialiasing", "stalker"),
    builtin_entry("Antialiasing", "tabula_rasa"),
    example!("Antialiasing", "kernels", "fxaa"),
    example!("Antialiasing", "gallery", "fxaa"),
    example!("Antialiasing", "gallery", "smaa_edges"),
    example!("Antialiasing", "gallery", "taa", number("share", &[0.1], 0.0, 1.0)),
    example!("Smoothing and blur", "kernels", "kuwahara"),
    example!("Smoothing and blur", "kernels", "bilateral"),
    example!("Smoothing and blur", "kernels", "gaussian"),
    example!("Smoothing and blur", "kernels", "median"),
    example!("Smoothing and blur", "gallery", "nlm"),
    example!(
        "Smoothing and blur",
        "gallery",
        "atrous",
        number("spacing", &[2.0], 1.0, 8.0),
        number("sigma", &[0.5], 0.01, 4.0)
    ),
    example!("Smoothing and blur", "gallery", "dual_kawase"),
    example!(
        "Smoothing and blur",
        "gallery",
        "bokeh",
        number("focus", &[4.0], 0.5, 20.0),
        number("strength", &[6.0], 0.0, 20.0)
    ),
    example!("Smoothing and blur", "gallery", "motion_blur"),
    builtin_entry("Smoothing and blur", "quad_convolution"),
    builtin_entry("Smoothing and blur", "quad_bilateral"),
    example!("Edges and sharpening", "kernels", "sobel"),
    example!(
        "Edges and sharpening",
        "gallery",
        "canny",
        number("low", &[0.2], 0.0, 2.0),
        number("high", &[0.6], 0.0, 4.0)
    ),
    example!("Edges and sharpening", "kernels", "convolution"),
    example!(
        "Edges and sharpening",
        "gallery",
        "cas",
        number("sharpness", &[0.8], 0.0, 1.0)
    ),
    example!(
        "Edges and sharpening",
        "gallery",
        "rcas",
        number("stops", &[0.0], 0.0, 4.0)
    ),
    example!("Scaling", "kernels", "catmull_rom"; scale 2),
    example!("Scaling", "gallery", "lanczos"; scale 2),
    example!("Scaling", "gallery", "easu"; scale 2),
    example!("Scaling", "gallery", "scale2x"; scale 2),
    example!("Scaling", "kernels", "joint_bilateral_upsampling"),
    builtin_entry("Scaling", "quad_upsampling"),
    builtin_entry("Scaling", "downsampling"),
    example!("Light", "kernels", "ssao"),
    builtin_entry("Light", "quad_ssao"),
    example!(
        "Light",
        "gallery",
        "gtao",
        number("radius", &[0.8], 0.05, 4.0),
        number("focal", &[300.0], 50.0, 2000.0)
    ),
    example!(
        "Light",
        "gallery",
        "screen_space_reflections",
        number("focal", &[300.0], 50.0, 2000.0)
    ),
    example!(
        "Light",
        "gallery",
        "normal_from_depth",
        number("focal", &[300.0], 50.0, 2000.0)
    ),
    builtin_entry("Light", "pcf"),
    builtin_entry("Light", "pcss"),
    example!("Colour", "gallery", "aces", number("exposure", &[0.8], 0.0, 8.0)),
    example!(
        "Colour",
        "gallery",
        "oklab_grade",
        number("turn", &[1.5], -3.15, 3.15),
        number("chroma", &[1.2], 0.0, 3.0),
        number("lightness", &[1.0], 0.0, 2.0)
    ),
    example!(
        "Colour",
        "gallery",
        "ordered_dither",
        number("levels", &[3.0], 2.0, 16.0)
    ),
    example!(
        "Places",
        "gallery",
        "lens",
        number("k1", &[0.15], -0.3, 0.6),
        number("k2", &[0.02], -0.2, 0.4)
    ),
    example!(
        "Places",
        "gallery",
        "parallax_occlusion",
        number("view", &[0.3, 0.2, 0.93], -1.0, 1.0),
        number("depth", &[0.06], 0.0, 0.3)
    ),
    example!(
        "Places",
        "gallery",
        "environment_prefilter",
        number("roughness", &[0.3], 0.0, 1.0)
    ),
    example!(
        "Of nothing",
        "gallery",
        "mandelbrot"; unroll "none",
        number("centre", &[-0.6, 0.0], -2.0, 2.0),
        number("scale", &[2.4], 0.001, 4.0)
    ),
    example!(
        "Of nothing",
        "gallery",
        "sphere_tracing",
        number("angle", &[0.7], 0.0, 6.3)
    ),
    example!(
        "Of nothing",
        "gallery",
        "perlin",
        number("scale", &[90.0], 2.0, 300.0),
        number("depth", &[0.3], 0.0, 10.0),
        number("octaves", &[6.0], 1.0, 10.0)
    ),
    example!("Of nothing", "gallery", "worley", number("size", &[40.0], 4.0, 200.0)),
    example!("Of nothing", "gallery", "life"),
];

/// Every kernel of the page.
pub fn page_entries() -> &'static [Entry] {
    ENTRIES
}

impl Entry {
    /// The kernel's function.
    pub fn function_name(&self) -> &'static str {
        self.id.split_once('/').map_or(self.id, |(_, name)| name)
    }

    /// Summary in one line: of an example the beginning of its text.
    fn summary(&self) -> String {
        match self.example {
            None => straightline_kernels::find(self.id).map_or(String::new(), |entry| entry.summary.to_owned()),
            Some((_, text)) => {
                let lines = text.lines().map_while(|line| line.strip_prefix("//!"));
                let lines = lines.map(str::trim).take_while(|line| !line.is_empty());
                lines.collect::<Vec<_>>().join(" ")
            }
        }
    }
}

/// A kernel by its name.
pub fn find_kernel(id: &str) -> Result<Kernel, Refusal> {
    let entry = ENTRIES.iter().find(|entry| entry.id == id);
    let entry = entry.ok_or_else(|| Refusal::from_message(&format!("the page has no kernel `{id}`")))?;
    match entry.example {
        Some((path, text)) => Ok(Kernel::from_text(path, text, entry.function_name())),
        None => Ok(Kernel::builtin(id)?),
    }
}

/// The list, as the page shows it.
pub fn to_json() -> Value {
    let kernels = ENTRIES.iter().map(|entry| {
        let uniforms = entry.uniforms.iter();
        let uniforms = uniforms.map(|u| json!({ "name": u.name, "value": u.value, "min": u.min, "max": u.max }));
        json!({
            "id": entry.id, "name": entry.function_name(), "group": entry.group, "summary": entry.summary(),
            "example": entry.example.map(|(path, _)| path), "scale": entry.scale, "unroll": entry.unroll,
            "uniforms": uniforms.collect::<Vec<_>>(),
        })
    });
    // The form's own controls set the others.
    let own = ["set", "unroll", "branches", "transport", "block"];
    let computing = KNOBS
        .iter()
        .filter(|knob| knob.part == Part::Settings && !own.contains(&knob.name));
    let knobs = computing.map(|knob| {
        let initial = knob.value_texts(&ShaderSpec::new()).join(" ");
        json!({
            "name": knob.name, "value": knob.value, "help": knob.help(), "initial": initial,
            "many": knob.arity == Arity::Many,
        })
    });
    json!({
        "knobs": knobs.collect::<Vec<_>>(),
        "kernels": kernels.collect::<Vec<_>>(), "size": crate::scene::SIZE, "version": env!("CARGO_PKG_VERSION"),
        "engines": crate::engines::to_json(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The page has no buffers to fill a list in, and its scene no guide.
    const UNSHOWN: [&str; 6] = [
        "sraa_extra",
        "sraa_guide",
        "sraa_residual",
        "sraa_fit_sums",
        "sraa_fit_rows",
        "sraa_fit",
    ];

    #[test]
    fn every_built_in_kernel_is_there_and_every_example_says_what_it_is() {
        let shown = straightline_kernels::CATALOGUE
            .iter()
            .filter(|entry| !UNSHOWN.contains(&entry.name));
        for entry in shown {
            assert!(ENTRIES.iter().any(|e| e.id == entry.name), "`{}`", entry.name);
        }
        for entry in ENTRIES {
            assert!(!entry.summary().is_empty(), "`{}` has no summary", entry.id);
            assert!(ENTRIES.iter().filter(|e| e.id == entry.id).count() == 1, "{}", entry.id);
        }
    }
}
