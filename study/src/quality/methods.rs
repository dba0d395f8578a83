//! The methods that are compared.

use crate::baselines::Transfer;
use crate::builtin::load_builtin;
use crate::record::Family;
use straightline_codegen::Kernel;
use straightline_codegen::diagnostic::Errors;
use straightline_kernels::{OptionText, OptionValues};
use straightline_scene::capture::{Capture, ShadingSample};
use straightline_scene::gbuffer;
use straightline_scene::render::{self, PlacedBy};
use straightline_scene::scene::Camera;

/// Kind of a method, beyond its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MethodKind {
    /// The shaded picture as it is.
    Plain,
    /// The kernel `sraa`.
    Sraa,
    /// A built-in kernel that reads depth, normals and colour of one sample a pixel.
    Edge(&'static str),
    /// FXAA.
    Fxaa(Transfer),
    /// SMAA.
    Smaa(Transfer),
    /// MLAA, on the processor.
    Mlaa,
    /// The kernel `sraa` with a mask, and MLAA in the pixels that the mask keeps.
    Merged,
    /// Coverage of the samples of `latin4`, and shading once a surface in each pixel.
    Multisampled,
    /// Coverage and shading as `Multisampled`, resolved by the directionally adaptive filter.
    Directional,
    /// Shading at every sample of `latin4` in pixels with several surfaces, and at one in all others.
    Classified,
    /// Coverage of the samples of `latin16`, and the colours of four of them.
    Covered,
    /// Shading at every sample of `latin4` or `latin16`.
    Supersampled(usize),
    /// Shading of at most two aggregates of a pixel's samples.
    Aggregated,
    /// A kernel of the user's, which reads what it likes of `color`, `depth` and `normal`.
    Own,
}

/// A method of antialiasing.
#[derive(Clone, Debug)]
pub struct Method {
    /// For people.
    pub name: String,
    /// Kind of the method.
    pub kind: MethodKind,
    /// The kernel, if it is the user's.
    pub kernel: Option<Kernel>,
    /// Options of its kernel that are set, for records and for compiling it.
    options: Vec<OptionText>,
    /// Values of all of its kernel's options.
    values: OptionValues,
    /// True if the method's pictures are written.
    pub pictured: bool,
    /// True if the method is watched over the pan.
    pub panned: bool,
    /// True if the method comes after bloom and tone mapping where those are, though it could come before.
    pub last: bool,
    /// True if the difference to supersampling at the method's samples is accounted for.
    pub explained: bool,
    /// Scene units from the upper to the lower edge of pictures of a camera with parallel rays, if it is for one.
    parallel_height: Option<f32>,
    /// True if temporal antialiasing comes after the method, in motion.
    pub has_taa: bool,
}

impl Method {
    pub(super) fn new(name: &str, kind: MethodKind, options: &[(&str, &str)]) -> Method {
        let own = |(name, value): &(&str, &str)| ((*name).to_owned(), (*value).to_owned());
        let method = Method {
            name: name.to_owned(),
            kind,
            kernel: None,
            options: Vec::new(),
            values: OptionValues::default(),
            pictured: false,
            panned: false,
            last: false,
            explained: false,
            parallel_height: None,
            has_taa: false,
        };
        method.with_options(options.iter().map(own).collect())
    }

    /// Sets these options, in their canonical spelling. Options that the method's kernel refuses are an error where it is
    /// compiled.
    fn with_options(self, mut options: Vec<OptionText>) -> Method {
        let values = self.parse_options(&options).unwrap_or_default();
        for (name, text) in &mut options {
            if let Some(value) = values.get(name) {
                *text = value.to_string();
            }
        }
        Method {
            options,
            values,
            ..self
        }
    }

    /// Values of all options of its kernel, of `sraa` where it has none, under these settings.
    fn parse_options(&self, options: &[OptionText]) -> Result<OptionValues, Errors> {
        match (&self.kernel, self.kind) {
            (Some(kernel), _) => kernel.option_values(options),
            (None, MethodKind::Edge(name)) => load_builtin(name)?.option_values(options),
            (None, _) => load_builtin("sraa")?.option_values(options),
        }
    }

    /// Options of its kernel that are set.
    pub fn options(&self) -> &[OptionText] {
        &self.options
    }

    /// A method of the user's, `NAME=KERNEL[,OPTION=VALUE...]`: a set of options of `sraa` or of an edge filter, or a kernel of a
    /// file. What has no `=` belongs to the value before it, which is a list then.
    ///
    /// # Errors
    ///
    /// [`OwnError`] says what cannot be read, or what is wrong with the kernel.
    pub fn parse_own(text: &str) -> Result<Method, OwnError> {
        let usage = || OwnError::Usage(text.to_owned());
        let (name, rest) = text.split_once('=').ok_or_else(usage)?;
        let mut parts = rest.split(',');
        let kernel = parts.next().unwrap_or_default();
        if to_file_stem(name).is_empty() || kernel.is_empty() {
            return Err(usage());
        }
        let mut options: Vec<OptionText> = Vec::new();
        for part in parts {
            match (part.split_once('='), options.last_mut()) {
                (Some((option, value)), _) => options.push((option.to_owned(), value.to_owned())),
                (None, Some((_, list))) => *list += &format!(",{part}"),
                (None, None) => return Err(usage()),
            }
        }
        let (kind, own) = match kernel {
            "sraa" => (MethodKind::Sraa, None),
            "stalker" => (MethodKind::Edge("stalker"), None),
            "tabula_rasa" => (MethodKind::Edge("tabula_rasa"), None),
            file => (MethodKind::Own, Some(Kernel::from_argument(file)?)),
        };
        let method = Method {
            kernel: own,
            ..Method::new(name, kind, &[]).main()
        };
        method.parse_options(&options)?;
        let method = method.with_options(options);
        match gbuffer::pattern_offsets(method.pattern()) {
            Some(_) => Ok(method),
            None => Err(OwnError::Pattern(name.to_owned(), method.pattern().to_owned())),
        }
    }

    /// Restricts the method to the capture's own samples.
    pub fn for_capture(&self, capture: &Capture) -> Method {
        if self.kind != MethodKind::Sraa {
            return self.clone();
        }
        let own = capture
            .camera
            .map_or_else(|| self.clone(), |camera| self.for_camera(&camera));
        let given = |name: &str| own.options.iter().any(|(own, _)| own == name);
        let sampled = gbuffer::sampled_at(capture).into_iter();
        let options = sampled
            .filter(|(name, _)| !given(name))
            .chain(own.options.iter().cloned());
        let options = options.collect();
        own.with_options(options)
    }

    /// Returns the method for a camera: the options of SRAA depend on its projection.
    pub fn for_camera(&self, camera: &Camera) -> Method {
        match (self.kind, camera.parallel_height) {
            (MethodKind::Sraa | MethodKind::Merged, Some(height)) => Method {
                parallel_height: Some(height),
                ..self
                    .clone()
                    .with_options(gbuffer::in_parallel(&self.options, &self.values, height))
            },
            _ => self.clone(),
        }
    }

    /// Returns the options of the kernel `sraa_place` that goes with the method.
    pub fn placing_options(&self) -> Result<Vec<OptionText>, Errors> {
        self.for_projection(self.placed_by().instead_of(&self.options))
    }

    /// Returns the options of the kernel `sraa_extra` that goes with the method.
    pub fn listing_options(&self) -> Result<Vec<OptionText>, Errors> {
        self.for_projection(render::listing_options(&self.options))
    }

    /// Changes options to suit the method's camera.
    fn for_projection(&self, options: Vec<OptionText>) -> Result<Vec<OptionText>, Errors> {
        Ok(match self.parallel_height {
            Some(height) => gbuffer::in_parallel(&options, &self.parse_options(&options)?, height),
            None => options,
        })
    }

    fn with_gap_analysis(self) -> Method {
        Method {
            explained: true,
            ..self
        }
    }

    /// Marks the method as one of the few that are shown and watched.
    fn main(self) -> Method {
        Method {
            pictured: true,
            panned: true,
            ..self
        }
    }

    pub(super) fn with_taa(self) -> Method {
        Method { has_taa: true, ..self }
    }

    fn with_picture(self) -> Method {
        Method { pictured: true, ..self }
    }

    /// Returns the method's kind in records.
    pub fn family(&self) -> Family {
        match self.kind {
            MethodKind::Plain => Family::None,
            MethodKind::Sraa | MethodKind::Merged => Family::Sraa,
            MethodKind::Edge(_) => Family::Edge,
            MethodKind::Fxaa(_) | MethodKind::Smaa(_) | MethodKind::Mlaa => Family::Picture,
            MethodKind::Multisampled
            | MethodKind::Directional
            | MethodKind::Classified
            | MethodKind::Covered
            | MethodKind::Aggregated
            | MethodKind::Supersampled(_) => Family::Supersampling,
            MethodKind::Own => Family::Own,
        }
    }

    /// Returns whether the method comes after bloom and tone mapping where those are: filters of the displayed picture do.
    pub fn is_last(&self) -> bool {
        self.last || matches!(self.kind, MethodKind::Fxaa(_) | MethodKind::Smaa(_) | MethodKind::Mlaa)
    }

    /// The pattern of its geometry samples.
    pub fn pattern(&self) -> &str {
        match self.kind {
            MethodKind::Supersampled(16) | MethodKind::Covered => "latin16",
            _ => self.values.choice("pattern").unwrap_or("latin4"),
        }
    }

    /// Returns the place of shading in the method's picture.
    pub fn shading_sample(&self) -> ShadingSample {
        if self.values.choice("shading") == Some("placed") {
            return ShadingSample::Placed;
        }
        match self.shaded_samples() {
            [] => ShadingSample::Centre,
            [only] => ShadingSample::Sample(*only as usize),
            several => ShadingSample::Samples(several.iter().map(|k| *k as usize).collect()),
        }
    }

    /// Geometry samples at which its picture is shaded; none where it is shaded elsewhere.
    fn shaded_samples(&self) -> &[f64] {
        self.values.numbers("shaded").unwrap_or_default()
    }

    /// Returns the metric of surfaces where its picture is placed: planes if the filter goes by them.
    pub fn placed_by(&self) -> PlacedBy {
        PlacedBy::from_options(&self.values)
    }

    /// Returns whether the method reads albedo at every geometry sample.
    pub fn reads_albedo(&self) -> bool {
        self.values.choice("demodulate").is_some_and(|what| what != "none")
    }

    /// Returns whether the method reads a guide at every geometry sample.
    pub fn reads_guide(&self) -> bool {
        self.values.choice("guide") == Some("add")
    }

    /// Returns whether a guide's scale is fitted for the method.
    pub fn fits_guide(&self) -> bool {
        self.reads_guide() && self.values.flag("fitted") == Some(true)
    }

    /// Returns whether some pixels are shaded once more for the method.
    pub fn has_extra(&self) -> bool {
        self.values.flag("extra") == Some(true)
    }

    /// Returns the name of the capture that the method reads, of all that a scene is drawn in: its pattern, and its place of
    /// shading unless that is the pixel's centre.
    pub fn capture_name(&self) -> String {
        match (self.values.get("shaded"), self.shading_sample()) {
            (Some(list), _) if !self.shaded_samples().is_empty() => format!("{} shaded at {list}", self.pattern()),
            (_, ShadingSample::Placed) => {
                let by = match self.placed_by() {
                    PlacedBy::Depths => "depths",
                    PlacedBy::Planes => "planes",
                };
                format!("{} placed by {by}", self.pattern())
            }
            _ => self.pattern().to_owned(),
        }
    }

    /// Name of its picture's file, without extension.
    pub fn file_stem(&self) -> String {
        to_file_stem(&self.name)
    }
}

/// Why a method of the user's cannot be compared.
#[derive(Debug, thiserror::Error)]
pub enum OwnError {
    /// The text does not describe a method.
    #[error(
        "`{0}` is no method: write NAME=KERNEL, then options: \"eight=sraa,pattern=standard8\" or \"mine=filter.rs::sharp\""
    )]
    Usage(String),
    /// The scene is not drawn at such samples.
    #[error(
        "the method `{0}` has the pattern `{1}`, and scenes are drawn at named ones: latin4, latin16, standard8 and the like"
    )]
    Pattern(String, String),
    /// The kernel cannot be read.
    #[error("{0}")]
    Kernel(#[from] Errors),
}

/// A name made of lower-case letters, digits and hyphens.
pub fn to_file_stem(name: &str) -> String {
    let words = name.to_lowercase();
    let words = words.split(|c: char| !c.is_ascii_alphanumeric());
    words.filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-")
}

/// All methods; with `quick` without the variants of SRAA that differ little.
pub fn list_methods(quick: bool) -> Vec<Method> {
    let sraa = |name, options: &[(&str, &str)]| Method::new(name, MethodKind::Sraa, options);
    let mut all = vec![
        Method::new("1x", MethodKind::Plain, &[]).main(),
        sraa("SRAA 4", &[]).main().with_gap_analysis(),
        sraa("SRAA 16", &[("pattern", "latin16")]).main().with_gap_analysis(),
    ];
    all.extend(extension_variants());
    all.extend(presets());
    all.extend(metric_variants());
    all.extend(radius_variants());
    all.extend(resolve_variants());
    all.push(sraa("SRAA 4, two shading samples", &[LISTED, ("shaded", "0,3")]));
    if !quick {
        all.extend([
            sraa(
                "SRAA 16, planes and normals",
                &[("pattern", "latin16"), ("metric", "planes-normals")],
            ),
            sraa("SRAA 4, ordered", &[("pattern", "ordered4")]),
            sraa("SRAA 8, standard", &[("pattern", "standard8")]),
            sraa("SRAA 16, standard", &[("pattern", "standard16")]),
            sraa("SRAA 16, ordered", &[("pattern", "ordered16")]),
        ]);
        all.extend(falloff_variants());
        all.extend([
            sraa(
                "SRAA 16, two shading samples",
                &[("pattern", "latin16"), LISTED, ("shaded", "13,5")],
            ),
            sraa(
                "SRAA 16, four shading samples",
                &[("pattern", "latin16"), LISTED, ("shaded", "10,12,6,1")],
            ),
        ]);
    }
    all.extend([
        Method::new("S.T.A.L.K.E.R.", MethodKind::Edge("stalker"), &[]),
        Method::new("Tabula Rasa", MethodKind::Edge("tabula_rasa"), &[]),
    ]);
    all.extend(of_the_picture());
    all.extend([
        Method::new("SRAA 4 and MLAA", MethodKind::Merged, &[("mask", "select")]).with_picture(),
        Method::new("MSAA 4", MethodKind::Multisampled, &[]).with_picture(),
        Method::new("MSAA 4, directional", MethodKind::Directional, &[]).with_picture(),
        Method::new("MSAA 4, deferred", MethodKind::Classified, &[]).with_picture(),
        Method::new("CSAA 16", MethodKind::Covered, &[]).with_picture(),
        Method::new("AGAA 4", MethodKind::Aggregated, &[]).with_picture(),
        Method::new("AGAA 16", MethodKind::Aggregated, &[("pattern", "latin16")]).with_picture(),
        Method::new("4x", MethodKind::Supersampled(4), &[]).main(),
        Method::new("16x", MethodKind::Supersampled(16), &[]).main(),
    ]);
    all
}

/// Samples of `latin16` near those of `latin4`.
pub const NEAR_LATIN4: [usize; 4] = [10, 3, 11, 5];

/// Shading at more than one place of a pixel: samples opposite to each other, and of sixteen four near those of `latin4`.
const LISTED: (&str, &str) = ("shading", "listed");

/// Beyond the paper: shading where geometry asks for it, a search for what no tap shows, and light apart from paint and shadow.
fn extension_variants() -> Vec<Method> {
    let mut all = Vec::new();
    for (samples, pattern) in [("4", "latin4"), ("16", "latin16")] {
        let sraa = |what: &str, options: &[(&str, &str)]| {
            let basis = [("pattern", pattern), RELATIVE[0], RELATIVE[1]];
            Method::new(
                &format!("SRAA {samples}, {what}"),
                MethodKind::Sraa,
                &[&basis, options].concat(),
            )
        };
        all.extend([
            sraa("searched", &[SEARCHED]),
            sraa("placed", &[PLACED]),
            sraa("placed and searched", &[PLACED, SEARCHED]).main(),
            sraa("demodulated by albedo", &[("demodulate", "albedo")]),
            sraa("demodulated", &[DEMODULATED]).with_picture(),
            sraa("placed, searched and demodulated", &[PLACED, SEARCHED, DEMODULATED]).with_picture(),
            sraa(
                "placed, searched, demodulated and rest apart",
                &[PLACED, SEARCHED, DEMODULATED, ("rest", "true")],
            )
            .with_picture(),
        ]);
        let by_planes = |what: &str, options: &[(&str, &str)]| {
            let basis = [&[("pattern", pattern)], PlacedBy::Planes.options(), options].concat();
            Method::new(&format!("SRAA {samples}, {what}"), MethodKind::Sraa, &basis)
        };
        all.extend([
            by_planes("placed and searched by planes", &[PLACED, SEARCHED]).main(),
            by_planes("kept even", &KEPT_EVEN),
            by_planes(
                "placed, searched and kept even",
                &[&[PLACED, SEARCHED], &KEPT_EVEN[..]].concat(),
            )
            .main(),
            by_planes(
                "placed, searched, kept even and extra",
                &[&[PLACED, SEARCHED, ("extra", "true")], &KEPT_EVEN[..]].concat(),
            )
            .with_picture(),
        ]);
    }
    all
}

/// Returns the names of methods that show what the presets of SRAA are worth: no antialiasing, the presets, and supersampling.
pub fn preset_names() -> Vec<String> {
    let around = ["1x", "SRAA 4", "SRAA 16", "4x", "16x"].map(str::to_owned);
    around
        .into_iter()
        .chain(presets().into_iter().map(|method| method.name))
        .collect()
}

/// The presets of the filter.
fn presets() -> Vec<Method> {
    let mut all = Vec::new();
    for (samples, pattern) in [("4", "latin4"), ("16", "latin16")] {
        for name in ["fast", "edges", "full", "guided"] {
            let options = [("preset", name), ("pattern", pattern)];
            all.push(Method::new(
                &format!("SRAA {samples}, {name}"),
                MethodKind::Sraa,
                &options,
            ));
        }
        let options = [("preset", "guided"), ("pattern", pattern), ("fitted", "false")];
        all.push(Method::new(
            &format!("SRAA {samples}, guided, unscaled"),
            MethodKind::Sraa,
            &options,
        ));
    }
    all
}

/// Options that keep a pixel's colour where its samples show one plane.
const KEPT_EVEN: [(&str, &str); 2] = [("mask", "branch"), ("variation", "within")];

pub(super) const PLACED: (&str, &str) = ("shading", "placed");
pub(super) const SEARCHED: (&str, &str) = ("search", "five");
const DEMODULATED: (&str, &str) = ("demodulate", "albedo-shadow");

fn metric_variants() -> Vec<Method> {
    let sraa = |name, metric| Method::new(name, MethodKind::Sraa, &[("metric", metric)]);
    vec![
        sraa("SRAA 4, planes and normals", "planes-normals"),
        Method::new(
            "SRAA 4, planes of taps and normals",
            MethodKind::Sraa,
            &[("metric", "planes-normals"), ("plane", "tap")],
        ),
        sraa("SRAA 4, normals", "normals"),
        sraa("SRAA 4, depth", "depth"),
    ]
}

/// A step of a third of the depth, and more, is between unrelated surfaces.
pub(super) const RELATIVE: [(&str, &str); 2] = [("difference", "relative"), ("depth-scale", "3")];

/// Filters of the reconstructed samples.
fn resolve_variants() -> Vec<Method> {
    let sraa = |name, options: &[(&str, &str)]| Method::new(name, MethodKind::Sraa, options);
    vec![
        sraa("SRAA 4, tent 0.75", &[("resolve", "tent"), ("resolve-radius", "0.75")]),
        sraa("SRAA 4, tent", &[("resolve", "tent")]),
        sraa("SRAA 4, tent 1.5", &[("resolve", "tent"), ("resolve-radius", "1.5")]),
        sraa("SRAA 4, gaussian", &[("resolve", "gaussian")]),
        sraa(
            "SRAA 4, mitchell 1.5",
            &[("resolve", "mitchell"), ("resolve-radius", "1.5")],
        ),
        sraa(
            "SRAA 4, lanczos 1.5",
            &[("resolve", "lanczos"), ("resolve-radius", "1.5")],
        ),
    ]
}

fn radius_variants() -> Vec<Method> {
    let sraa = |name, options: &[(&str, &str)]| Method::new(name, MethodKind::Sraa, options);
    vec![
        sraa("SRAA 4, radius 1.5", &[("radius", "1.5")]),
        sraa("SRAA 4, radius 2", &[("radius", "2")]),
        sraa("SRAA 16, radius 2", &[("pattern", "latin16"), ("radius", "2")]),
    ]
}

fn falloff_variants() -> Vec<Method> {
    let sraa = |name, options: &[(&str, &str)]| Method::new(name, MethodKind::Sraa, options);
    vec![
        sraa("SRAA 4, no falloff", &[("falloff", "none")]),
        sraa("SRAA 4, Gaussian falloff", &[("falloff", "gaussian")]),
        sraa("SRAA 4, relative depth", &RELATIVE),
        sraa(
            "SRAA 16, relative depth",
            &[("pattern", "latin16"), RELATIVE[0], RELATIVE[1]],
        ),
        sraa("SRAA 4, mask", &[("mask", "select")]),
    ]
}

fn of_the_picture() -> Vec<Method> {
    vec![
        Method::new("FXAA", MethodKind::Fxaa(Transfer::Srgb), &[]).main(),
        Method::new("FXAA on light", MethodKind::Fxaa(Transfer::Linear), &[]),
        Method::new("SMAA", MethodKind::Smaa(Transfer::Srgb), &[]).main(),
        Method::new("SMAA on light", MethodKind::Smaa(Transfer::Linear), &[]),
        Method::new("MLAA", MethodKind::Mlaa, &[]).main(),
    ]
}

/// The methods that a capture can feed, and those that it cannot with the reason.
pub fn methods_of(capture: &Capture) -> (Vec<Method>, Vec<(String, String)>) {
    let sampled = gbuffer::sampled_at(capture);
    let with = |options: &[(&str, &str)]| {
        let own = |(name, value): &(&str, &str)| ((*name).to_owned(), (*value).to_owned());
        sampled
            .iter()
            .cloned()
            .chain(options.iter().map(own))
            .collect::<Vec<_>>()
    };
    let samples = capture.samples.len();
    let sraa = |what: &str, options: &[(&str, &str)]| {
        let method = Method::new(&format!("SRAA {samples}{what}"), MethodKind::Sraa, &[]).with_options(with(options));
        match &capture.camera {
            Some(camera) => method.for_camera(camera),
            None => method,
        }
    };
    let normals = capture.normal.is_some();
    let mut all = vec![Method::new("1x", MethodKind::Plain, &[]).with_picture()];
    let mut absent: Vec<(String, String)> = Vec::new();
    let no_normals = "the capture has no normal.exr";
    if normals {
        all.push(sraa("", &[]).with_picture());
        all.push(sraa(", normals", &[("metric", "normals")]));
        all.push(sraa(", no falloff", &[("falloff", "none")]));
        all.push(sraa(", Gaussian falloff", &[("falloff", "gaussian")]));
        all.push(sraa(", relative depth", &RELATIVE));
        all.push(sraa(", mask", &[("mask", "select")]));
        match (&capture.albedo, &capture.direct) {
            (Some(_), Some(_)) => {
                all.push(sraa(", demodulated", &[RELATIVE[0], RELATIVE[1], DEMODULATED]).with_picture())
            }
            (Some(_), None) => {
                let of_albedo = [RELATIVE[0], RELATIVE[1], ("demodulate", "albedo")];
                all.push(sraa(", demodulated", &of_albedo).with_picture());
            }
            (None, _) => {
                let reason = "the capture has no albedo.exr".to_owned();
                absent.push((format!("SRAA {samples}, demodulated"), reason));
            }
        }
        if capture.camera.is_some() {
            all.push(sraa(", planes and normals", &[("metric", "planes-normals")]));
        } else {
            let reason = "capture.json has no camera".to_owned();
            absent.push((format!("SRAA {samples}, planes and normals"), reason));
        }
        if capture.colors.is_empty() && capture.place.is_none() {
            all.push(Method::new("S.T.A.L.K.E.R.", MethodKind::Edge("stalker"), &[]));
            all.push(Method::new("Tabula Rasa", MethodKind::Edge("tabula_rasa"), &[]));
        } else {
            let reason = "the capture is not shaded at one place in all pixels".to_owned();
            absent.push(("S.T.A.L.K.E.R., Tabula Rasa".to_owned(), reason));
        }
    } else {
        absent.push((format!("SRAA {samples} with normals"), no_normals.to_owned()));
        absent.push(("S.T.A.L.K.E.R., Tabula Rasa".to_owned(), no_normals.to_owned()));
    }
    all.push(Method {
        pictured: !normals,
        ..sraa(", depth", &[("metric", "depth")])
    });
    all.extend(of_the_picture());
    let once = "a capture is not shaded at every sample";
    absent.push((
        "MSAA, CSAA, 4x, 16x, and the share of the gap to 16x".to_owned(),
        once.to_owned(),
    ));
    absent.push(("the pan".to_owned(), "a capture is one frame".to_owned()));
    (all, absent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn names_and_file_names_are_unique() {
        for quick in [false, true] {
            let all = list_methods(quick);
            let stems: BTreeSet<String> = all.iter().map(Method::file_stem).collect();
            assert_eq!(stems.len(), all.len());
        }
        assert_eq!(to_file_stem("SRAA 4, no falloff"), "sraa-4-no-falloff");
    }

    #[test]
    fn options_are_those_of_the_kernels() {
        for method in list_methods(false) {
            let values = method.parse_options(&method.options);
            assert_eq!(values.expect(&method.name), method.values);
        }
    }

    #[test]
    fn what_is_read_follows_the_options() {
        let all = list_methods(false);
        let of = |name: &str| all.iter().find(|method| method.name == name).expect("a method");
        assert_eq!(
            (of("SRAA 16").capture_name(), of("SRAA 16").shading_sample()),
            ("latin16".to_owned(), ShadingSample::Centre)
        );
        let two = of("SRAA 16, two shading samples");
        assert_eq!(two.capture_name(), "latin16 shaded at 13,5");
        assert_eq!(two.shading_sample(), ShadingSample::Samples(vec![13, 5]));
    }
}
