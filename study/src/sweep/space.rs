//! Space of a sweep: its axes, and every variant.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use straightline_codegen::emit::{EmitOptions, Emitted, Target};
use straightline_codegen::spec::{Arity, Knob, Part};
use straightline_codegen::{Compiled, Format, Kernel, ShaderSpec, Stage, Unroll};
use straightline_kernels::OptionText;

/// Treatment of a loop left in the shader.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Loops {
    /// wgpu counts its iterations, as it does for every shader that it does not trust.
    #[default]
    Bounded,
    /// The loop is compiled as it stands, which lets a driver unroll it.
    Unbounded,
}

impl Loops {
    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Loops::Bounded => "bounded",
            Loops::Unbounded => "unbounded",
        }
    }
}

/// A varied setting: its name, and its values in order.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Axis {
    /// Name of an option of the kernel, or one of [`RESERVED`].
    pub name: String,
    /// Values; at least one.
    pub values: Vec<String>,
}

/// Names of axes that every sweep has, after those of the options.
pub const RESERVED: [&str; 5] = ["unroll", "loops", "stage", "workgroup", "block"];

/// The knob of a shader that is an axis by this name, beside [`RESERVED`].
///
/// # Errors
///
/// There is none, or it does not change what is measured.
pub fn varied_knob(name: &str) -> Result<&'static Knob, String> {
    let knob = Knob::find(name)?;
    let limits = ["budget", "time-limit", "memory-limit"];
    let is_computed = knob.part == Part::Settings && knob.arity != Arity::Many && !limits.contains(&knob.name);
    match knob.name {
        name if RESERVED.contains(&name) => Err(format!("`{name}` is an axis of every sweep: --{name}")),
        "precision" => Ok(knob),
        _ if is_computed => Ok(knob),
        name => Err(format!(
            "`{name}` is no axis: it changes neither what is computed nor in which precision"
        )),
    }
}

/// A way to write a kernel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variant {
    /// Options that are not left at their default.
    pub options: Vec<OptionText>,
    /// Further knobs by name, with a text of each.
    pub knobs: Vec<(&'static str, String)>,
    /// Loop policy.
    pub unroll: Unroll,
    /// Treatment of loops left in the shader.
    pub loops: Loops,
    /// Pipeline stage.
    pub stage: Stage,
    /// Invocations of a compute workgroup, across and down.
    pub workgroup: [u32; 2],
    /// Pixels of a compute invocation, across and down.
    pub block: [u32; 2],
}

/// All values of everything that is varied. Each list has at least one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Space {
    /// Options of the kernel, each with its values.
    pub options: Vec<(String, Vec<String>)>,
    /// Further knobs ([`varied_knob`]), each with texts of its values.
    pub knobs: Vec<(&'static str, Vec<String>)>,
    /// Loop policies.
    pub unroll: Vec<Unroll>,
    /// Treatments of loops left in the shader.
    pub loops: Vec<Loops>,
    /// Pipeline stages.
    pub stages: Vec<Stage>,
    /// Invocations of a compute workgroup, across and down.
    pub workgroups: Vec<[u32; 2]>,
    /// Pixels of a compute invocation, across and down.
    pub blocks: Vec<[u32; 2]>,
}

impl Default for Space {
    /// Nothing is varied.
    fn default() -> Self {
        Space {
            options: Vec::new(),
            knobs: Vec::new(),
            unroll: vec![Unroll::Full],
            loops: vec![Loops::Bounded],
            stages: vec![Stage::Compute],
            workgroups: vec![EmitOptions::WORKGROUP],
            blocks: vec![[1, 1]],
        }
    }
}

impl Space {
    /// Everything that is varied, with the names of the values: options first, then further knobs, then those of [`RESERVED`].
    pub fn axes(&self) -> Vec<Axis> {
        let knobs = self
            .knobs
            .iter()
            .map(|(name, values)| ((*name).to_owned(), values.clone()));
        let options = self.options.iter().cloned().chain(knobs);
        let fixed: [Vec<String>; 5] = [
            self.unroll.iter().map(Unroll::to_string).collect(),
            self.loops.iter().map(|loops| loops.name().to_owned()).collect(),
            self.stages.iter().map(|stage| stage.name().to_owned()).collect(),
            self.workgroups.iter().map(format_size).collect(),
            self.blocks.iter().map(format_size).collect(),
        ];
        let fixed = RESERVED.map(str::to_owned).into_iter().zip(fixed);
        options
            .chain(fixed)
            .map(|(name, values)| Axis { name, values })
            .collect()
    }

    /// Spells the values of options as `kernel` does, so that a value has one name in records. A value that the kernel refuses
    /// stays as it is, and its variants are refused.
    pub fn spelled_by(mut self, kernel: &Kernel) -> Space {
        for (name, values) in &mut self.options {
            values
                .iter_mut()
                .for_each(|value| *value = spell_value(kernel, name, value));
        }
        self
    }

    /// Every combination, the last axis fastest. A fragment has neither workgroup nor block: in that stage their first values
    /// stand for all.
    pub fn variants(&self) -> Vec<Variant> {
        let knobs = self.knobs.iter().map(|(name, values)| (*name, values.as_slice()));
        let knobs = combine_values(knobs);
        let of_options = combine_values(
            self.options
                .iter()
                .map(|(name, values)| (name.clone(), values.as_slice())),
        );
        let each = of_options
            .iter()
            .flat_map(|options| knobs.iter().map(move |knobs| (options, knobs)));
        let mut all = Vec::new();
        for (options, knobs) in each {
            for &unroll in &self.unroll {
                for &loops in &self.loops {
                    for &stage in &self.stages {
                        let of_compute = |length: usize| if stage == Stage::Compute { length } else { 1 };
                        for &workgroup in &self.workgroups[..of_compute(self.workgroups.len())] {
                            for &block in &self.blocks[..of_compute(self.blocks.len())] {
                                all.push(Variant {
                                    options: options.clone(),
                                    knobs: knobs.clone(),
                                    unroll,
                                    loops,
                                    stage,
                                    workgroup,
                                    block,
                                });
                            }
                        }
                    }
                }
            }
        }
        all
    }
}

impl Variant {
    /// The value of every axis.
    pub fn axis_values(&self) -> BTreeMap<String, String> {
        let fixed = [
            self.unroll.to_string(),
            self.loops.name().to_owned(),
            self.stage.name().to_owned(),
            format_size(&self.workgroup),
            format_size(&self.block),
        ];
        let fixed = RESERVED.map(str::to_owned).into_iter().zip(fixed);
        let knobs = self.knobs.iter().map(|(name, text)| ((*name).to_owned(), text.clone()));
        self.options.iter().cloned().chain(knobs).chain(fixed).collect()
    }

    /// The variant of a record, from the value of every axis.
    ///
    /// # Errors
    ///
    /// The value that is none of its axis.
    pub fn from_settings(
        kernel: &Kernel,
        axes: &[Axis],
        settings: &BTreeMap<String, String>,
    ) -> Result<Variant, String> {
        let value = |name: &str| {
            let value = settings.get(name).map(String::as_str);
            value.ok_or_else(|| format!("`{name}` has no value"))
        };
        let (mut options, mut knobs) = (Vec::new(), Vec::new());
        for axis in axes.iter().filter(|axis| !RESERVED.contains(&axis.name.as_str())) {
            let option = (axis.name.clone(), value(&axis.name)?.to_owned());
            // An option of the kernel takes precedence over a setting of that name.
            match kernel.option_values(std::slice::from_ref(&option)) {
                Ok(_) => options.push(option),
                Err(_) => knobs.push((varied_knob(&option.0)?.name, option.1)),
            }
        }
        let loops = [Loops::Bounded, Loops::Unbounded];
        Ok(Variant {
            options,
            knobs,
            unroll: value("unroll")?.parse()?,
            loops: loops
                .into_iter()
                .find(|loops| value("loops") == Ok(loops.name()))
                .ok_or("`loops` has no such value")?,
            stage: value("stage")?.parse()?,
            workgroup: parse_size(value("workgroup")?)?,
            block: parse_size(value("block")?)?,
        })
    }

    /// The shader, as a sweep measures it.
    pub(crate) fn emit(&self, compiled: &Compiled) -> Result<Emitted, String> {
        let options = self.spec()?.emit;
        let options = options
            .format(Format::Rgba32Float)
            .targets([Target::Wgsl, Target::Spirv]);
        compiled
            .emit(&options)
            .map_err(|errors| errors.first_message().to_owned())
    }

    /// The description of its shader.
    ///
    /// # Errors
    ///
    /// A text that is no value of its knob.
    pub fn spec(&self) -> Result<ShaderSpec, String> {
        let [width, height] = self.block;
        let mut spec = ShaderSpec::new()
            .unroll(self.unroll)
            .block(width, height)
            .stage(self.stage)
            .unbounded_loops(self.loops == Loops::Unbounded)
            // The loss is what is measured.
            .accept_loss(true);
        spec.settings.options.clone_from(&self.options);
        spec.emit.workgroup = (self.stage == Stage::Compute).then_some(self.workgroup);
        for (name, text) in &self.knobs {
            Knob::find(name)?.set(&mut spec, &[text])?;
        }
        Ok(spec)
    }
}

/// Every choice of one value of each, the last name's fastest.
fn combine_values<'v, N: Clone>(all: impl Iterator<Item = (N, &'v [String])>) -> Vec<Vec<(N, String)>> {
    let mut chosen = vec![Vec::new()];
    for (name, values) in all {
        let with = |known: &Vec<(N, String)>| {
            let each = values.iter().map(|value| (name.clone(), value.clone()));
            each.map(|one| [known.as_slice(), &[one]].concat()).collect::<Vec<_>>()
        };
        chosen = chosen.iter().flat_map(with).collect();
    }
    chosen
}

fn format_size(size: &[u32; 2]) -> String {
    format!("{}x{}", size[0], size[1])
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once('x');
    let sides = sides.and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
    sides.ok_or_else(|| format!("`{text}` is no size such as 16x16"))
}

/// A value of an option as `kernel` spells it; as it is if the kernel refuses it.
pub fn spell_value(kernel: &Kernel, name: &str, value: &str) -> String {
    let values = kernel.option_values(&[(name.to_owned(), value.to_owned())]).ok();
    let value_of = values.as_ref().and_then(|values| values.get(name));
    value_of.map_or_else(|| value.to_owned(), ToString::to_string)
}

/// The values that a text names: numbers from one to another as Rust has them, `1..9` or `1..=8`; or values separated by
/// commas, or by semicolons where a value has commas of its own.
///
/// # Errors
///
/// What is wrong with the text.
pub fn parse_values(text: &str) -> Result<Vec<String>, String> {
    if let Some(range) = parse_range(text) {
        return match range {
            Ok(range) if range.clone().count() == 0 => Err(format!("`{text}` is an empty range")),
            Ok(range) if range.clone().count() > MOST_VALUES => {
                Err(format!("`{text}` has more than {MOST_VALUES} values"))
            }
            Ok(range) => Ok(range.map(|number| number.to_string()).collect()),
            Err(why) => Err(why),
        };
    }
    let separator = if text.contains(';') { ';' } else { ',' };
    let mut values: Vec<String> = text.split(separator).map(|value| value.trim().to_owned()).collect();
    if separator == ';' && values.last().is_some_and(String::is_empty) {
        values.pop();
    }
    if values.iter().any(String::is_empty) {
        return Err(format!("`{text}` has an empty value"));
    }
    for (k, value) in values.iter().enumerate() {
        if values[..k].contains(value) {
            return Err(format!("`{text}` has the value `{value}` twice"));
        }
    }
    Ok(values)
}

/// Values of one axis, at most.
const MOST_VALUES: usize = 4096;

/// The numbers of a range; `None` of what is none.
fn parse_range(text: &str) -> Option<Result<std::ops::Range<i64>, String>> {
    let (from, to) = text.split_once("..")?;
    let (to, inclusive) = match to.strip_prefix('=') {
        Some(to) => (to, true),
        None => (to, false),
    };
    let bounds = (from.trim().parse::<i32>(), to.trim().parse::<i32>());
    let (Ok(from), Ok(to)) = bounds else {
        return Some(Err(format!(
            "`{text}` is no range of integers such as 1..9 or 1..=8, which are the same"
        )));
    };
    Some(Ok(i64::from(from)..i64::from(to) + i64::from(inclusive)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_those_of_rust() {
        let of = |text: &str| parse_values(text).map(|values| values.join(" "));
        assert_eq!(of("1..=4").unwrap(), "1 2 3 4");
        assert_eq!(of("1..4").unwrap(), "1 2 3");
        assert_eq!(of("-1..=1").unwrap(), "-1 0 1");
        assert_eq!(of("a, b").unwrap(), "a b");
        assert_eq!(of("1,2,1;1,4,1").unwrap(), "1,2,1 1,4,1");
        assert_eq!(of("1,2,1;").unwrap(), "1,2,1");
        for (text, says) in [
            ("8..1", "empty"),
            ("1..1", "empty"),
            ("1..x", "no range"),
            ("1..", "no range"),
            ("0..=2000000000", "more than"),
            ("a,,b", "empty value"),
            ("a,a", "twice"),
        ] {
            let error = of(text).expect_err(text);
            assert!(error.contains(says), "{text}: {error}");
        }
    }

    #[test]
    fn a_value_has_one_name() {
        let kernel = Kernel::builtin("sraa").expect("it is built in");
        let option = |name: &str, values: &[&str]| (name.to_owned(), values.iter().map(|v| (*v).to_owned()).collect());
        let space = Space {
            options: vec![option("tau", &["500.0", "1e2", "-1"]), option("nothing", &["1.0"])],
            ..Space::default()
        };
        let spelled = space.spelled_by(&kernel).options;
        assert_eq!(
            spelled,
            [option("tau", &["500", "100", "-1"]), option("nothing", &["1.0"])]
        );
    }

    #[test]
    fn every_combination_is_a_variant_once() {
        let space = Space {
            options: vec![("radius".to_owned(), parse_values("1..=3").unwrap())],
            unroll: vec![Unroll::None, Unroll::Full],
            stages: vec![Stage::Compute, Stage::Fragment],
            workgroups: vec![[8, 8], [16, 4]],
            ..Space::default()
        };
        let variants = space.variants();
        // Three radii, two policies; two workgroups of compute, and a fragment.
        assert_eq!(variants.len(), 3 * 2 * (2 + 1));
        for (k, variant) in variants.iter().enumerate() {
            assert!(!variants[..k].contains(variant));
            let settings = variant.axis_values();
            for axis in space.axes() {
                assert!(axis.values.contains(&settings[&axis.name]), "{settings:?}");
            }
        }
    }
}
