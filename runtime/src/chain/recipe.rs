//! A plan whose names are resolved, and compared with its shaders.

use crate::error::{ChainProblem, Error, Names};
use crate::inputs::{Abilities, check_readable};
use crate::layout::texture_format;
use crate::plan::{InputKind, Plan};
use crate::{PassOptions, ResourceKind, Shader};
use straightline_manifest::chain::{ChainPlan, PassPlan, SizeTerm};
use straightline_manifest::{Dimension, ValueType};
use wgpu::TextureFormat;

/// A plan without contradictions that fits its shaders.
#[derive(Debug)]
pub(super) struct Recipe {
    pub(super) plan: ChainPlan,
    /// In the order of the plan's passes.
    pub(super) steps: Vec<Step>,
    /// In the order of the plan's pictures.
    pub(super) formats: Vec<TextureFormat>,
    /// In the order of the plan's inputs; `None` for an input that no pass reads.
    pub(super) kinds: Vec<Option<ResourceKind>>,
    uniforms: Vec<Uniform>,
}

/// A pass, by numbers in the plan.
#[derive(Debug)]
pub(super) struct Step {
    /// Number in the list of shaders.
    pub(super) shader: usize,
    /// In the order of the plan's reads.
    pub(super) reads: Vec<Source>,
    /// Pictures, in the order of the shader's outputs.
    pub(super) writes: Vec<usize>,
    /// `true` if the shader is a compute shader.
    pub(super) computes: bool,
}

/// A resource or picture that a pass reads, by its number in the plan.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    Input(usize),
    Picture(usize),
}

/// A value that the caller sets, in all passes that have it.
#[derive(Debug)]
pub(super) struct Uniform {
    name: String,
    ty: ValueType,
    pub(super) passes: Vec<usize>,
}

impl Recipe {
    /// Compares `plan` with its shaders. `options` are those of the results.
    pub(super) fn new(plan: &ChainPlan, shaders: &[(&str, &Shader<'_>)], options: &PassOptions) -> Result<Self, Error> {
        plan.check().map_err(|bad| plan_error(plan, bad.place, bad.problem))?;
        check_shaders(plan, shaders)?;
        let steps = plan.passes.iter().map(|pass| Step::new(plan, pass, shaders));
        let steps = steps.collect::<Result<Vec<_>, _>>()?;
        Ok(Recipe {
            formats: choose_formats(plan, options)?,
            kinds: find_kinds(plan, shaders, &steps)?,
            uniforms: find_uniforms(plan, shaders, &steps)?,
            plan: plan.clone(),
            steps,
        })
    }

    /// Checks that the shaders can read the pictures that they are given.
    pub(super) fn check_reads(&self, shaders: &[(&str, &Shader<'_>)], abilities: &Abilities) -> Result<(), Error> {
        for (step, pass) in self.steps.iter().zip(self.plan.passes.iter()) {
            let (_, shader) = shaders[step.shader];
            for (source, read) in step.reads.iter().zip(pass.reads.iter()) {
                let Source::Picture(picture) = source else { continue };
                let input = shader.plan.inputs.iter().find(|input| input.name == read.name);
                let Some(InputKind::Texture(texture)) = input.map(|input| input.kind) else {
                    let problem = format!("reads picture `{}` as `{}`, which is no texture", read.from, read.name);
                    return Err(plan_error(&self.plan, format!("pass `{}`", pass.name), problem));
                };
                if texture.dimension != Dimension::D2 {
                    let problem = format!(
                        "reads picture `{}` as `{}`, which is not a plain 2d texture",
                        read.from, read.name
                    );
                    return Err(plan_error(&self.plan, format!("pass `{}`", pass.name), problem));
                }
                check_readable(&texture, abilities, self.formats[*picture]).map_err(|problem| {
                    let error = Error::Input {
                        kernel: shader.plan.kernel.to_string(),
                        name: read.name.to_string(),
                        problem,
                    };
                    self.name_pass(pass, &shader.plan, error)
                })?;
            }
        }
        Ok(())
    }

    /// The uniform `name`, which is to take a value of type `given`.
    pub(super) fn find_uniform(&self, name: &str, given: ValueType) -> Result<&Uniform, Error> {
        let kernel = || self.plan.chain.to_string();
        match self.uniforms.iter().find(|uniform| uniform.name == name) {
            Some(uniform) if uniform.ty == given => Ok(uniform),
            Some(uniform) => Err(Error::UniformType {
                kernel: kernel(),
                name: name.to_owned(),
                needed: uniform.ty.to_string(),
                given: given.to_string(),
            }),
            None => Err(Error::UnknownUniform {
                kernel: kernel(),
                name: name.to_owned(),
                known: self.uniforms.iter().map(|uniform| uniform.name.as_str()).collect(),
            }),
        }
    }

    /// An error of the chain.
    pub(super) fn error(&self, problem: ChainProblem) -> Error {
        Error::Chain {
            chain: self.plan.chain.to_string(),
            problem,
        }
    }

    /// Puts the names of the chain to an error of `pass`, which is in those of its shader. A lost device has nothing to
    /// do with a pass.
    pub(super) fn name_pass(&self, pass: &PassPlan, shader: &Plan, error: Error) -> Error {
        let read = |name: &str| {
            let read = pass.reads.iter().find(|read| read.name == name && read.from != name)?;
            Some(format!(", which reads `{}` as `{name}`", read.from))
        };
        let written = |name: Option<&str>| {
            let output = match name {
                Some(name) => shader.outputs.iter().position(|output| output.name == name)?,
                None => 0,
            };
            Some(format!(", which writes `{}`", pass.writes.get(output)?))
        };
        let role = match &error {
            Error::DeviceLost { .. } | Error::OutOfMemory { .. } => return error,
            Error::Input { name, .. } | Error::InputSampler { name, .. } | Error::InputBuffer { name, .. } => {
                read(name)
            }
            Error::Target { name, .. } => written(name.as_deref()),
            Error::TargetFormat { .. } if pass.writes.len() == 1 => written(None),
            _ => None,
        };
        self.error(ChainProblem::Pass {
            pass: pass.name.to_string(),
            role: role.unwrap_or_default(),
            error: Box::new(error),
        })
    }
}

impl Step {
    /// Resolves the names of `pass`. The plan has been checked.
    fn new(plan: &ChainPlan, pass: &PassPlan, shaders: &[(&str, &Shader<'_>)]) -> Result<Self, Error> {
        let wrong = |problem: String| plan_error(plan, format!("pass `{}`", pass.name), problem);
        let number = shaders.iter().position(|(name, _)| *name == pass.shader);
        let number = number.ok_or_else(|| {
            let given = shaders.iter().map(|(name, _)| *name).collect::<Names>();
            wrong(format!("its shader `{}` is not given; given: {given}", pass.shader))
        })?;
        let shader = &shaders[number].1.plan;
        let names = || shader.inputs.iter().map(|input| &*input.name).collect::<Names>();
        let missing = shader
            .inputs
            .iter()
            .find(|input| pass.reads.iter().all(|read| read.name != input.name));
        if let Some(input) = missing {
            return Err(wrong(format!(
                "its shader `{}` reads `{}`, and nothing is given for it",
                pass.shader, input.name
            )));
        }
        let extra = pass
            .reads
            .iter()
            .find(|read| shader.inputs.iter().all(|input| input.name != read.name));
        if let Some(read) = extra {
            return Err(wrong(format!(
                "reads `{}`, but its shader `{}` reads {}",
                read.name,
                pass.shader,
                names()
            )));
        }
        if pass.writes.len() != shader.outputs.len() {
            let (own, count) = (pass.writes.len(), shader.outputs.len());
            return Err(wrong(format!(
                "pictures written: {own}, outputs of its shader `{}`: {count}",
                pass.shader
            )));
        }
        let picture = |name: &str| plan.pictures.iter().position(|picture| picture.name == name);
        let input = |name: &str| plan.inputs.iter().position(|input| input == name);
        let reads = pass.reads.iter().map(|read| {
            let source = picture(&read.from)
                .map(Source::Picture)
                .or_else(|| input(&read.from).map(Source::Input));
            source.ok_or_else(|| wrong(format!("reads `{}`, which nothing has the name of", read.from)))
        });
        let writes = pass
            .writes
            .iter()
            .map(|name| picture(name).ok_or_else(|| wrong(format!("writes `{name}`, which is no picture"))));
        let writes: Vec<usize> = writes.collect::<Result<_, _>>()?;
        let has_tiles = shader.outputs.iter().all(|output| output.tile.is_some());
        let other = writes.iter().map(|picture| &plan.pictures[*picture]);
        let other = other
            .clone()
            .zip(other.skip(1))
            .find(|(first, next)| first.size != next.size);
        if let (Some((first, next)), false) = (other, has_tiles) {
            return Err(wrong(format!(
                "writes `{}` and `{}`, of unlike sizes, by a shader whose outputs have one size",
                first.name, next.name
            )));
        }
        Ok(Step {
            shader: number,
            reads: reads.collect::<Result<_, _>>()?,
            writes,
            computes: matches!(shader.stage, crate::plan::StagePlan::Compute { .. }),
        })
    }
}

/// An error about a part of the plan.
pub(super) fn plan_error(plan: &ChainPlan, place: String, problem: String) -> Error {
    Error::Chain {
        chain: plan.chain.to_string(),
        problem: ChainProblem::Plan { place, problem },
    }
}

/// Checks that each of `shaders` is given once and used.
fn check_shaders(plan: &ChainPlan, shaders: &[(&str, &Shader<'_>)]) -> Result<(), Error> {
    for (k, (name, _)) in shaders.iter().enumerate() {
        let problem = if shaders[..k].iter().any(|(earlier, _)| earlier == name) {
            "is given twice"
        } else if plan.passes.iter().all(|pass| pass.shader != *name) {
            "is given, and no pass has it"
        } else {
            continue;
        };
        return Err(plan_error(plan, format!("shader `{name}`"), problem.to_owned()));
    }
    Ok(())
}

/// Formats of the pictures: those of the plan, and for results those that `options` name.
fn choose_formats(plan: &ChainPlan, options: &PassOptions) -> Result<Vec<TextureFormat>, Error> {
    let refuse = |format, reason| Error::TargetFormat {
        kernel: plan.chain.to_string(),
        format,
        reason,
    };
    let results: Vec<&str> = plan.results().map(|result| &*result.name).collect();
    let known = || results.iter().copied().collect::<Names>();
    if let Some((name, format)) = options
        .formats
        .iter()
        .find(|(name, _)| !results.contains(&name.as_str()))
    {
        return Err(refuse(*format, format!("it writes no `{name}`; it writes {}", known())));
    }
    if let Some(format) = options.target_format
        && results.len() > 1
    {
        return Err(refuse(
            format,
            format!("it writes {}: say with `format_of` which is meant", known()),
        ));
    }
    let format = |picture: &straightline_manifest::chain::PicturePlan| {
        let named = options.formats.iter().rev().find(|(name, _)| *name == picture.name);
        let asked = named.map(|(_, format)| *format).or(options.target_format);
        asked
            .filter(|_| picture.memory.is_none())
            .unwrap_or_else(|| texture_format(picture.format))
    };
    Ok(plan.pictures.iter().map(format).collect())
}

/// Kinds of the inputs, in which all passes must agree. An input whose size is taken is a texture.
fn find_kinds(
    plan: &ChainPlan,
    shaders: &[(&str, &Shader<'_>)],
    steps: &[Step],
) -> Result<Vec<Option<ResourceKind>>, Error> {
    let mut kinds: Vec<Option<ResourceKind>> = vec![None; plan.inputs.len()];
    let terms = plan.pictures.iter().flat_map(|picture| picture.size.0.iter());
    for term in terms {
        let number = match term {
            SizeTerm::Of(name) => plan.inputs.iter().position(|input| input == name),
            _ => None,
        };
        if let Some(number) = number {
            kinds[number] = Some(ResourceKind::Texture);
        }
    }
    for (step, pass) in steps.iter().zip(plan.passes.iter()) {
        for (source, read) in step.reads.iter().zip(pass.reads.iter()) {
            let Source::Input(number) = *source else { continue };
            let inputs = &shaders[step.shader].1.plan.inputs;
            let Some(input) = inputs.iter().find(|input| input.name == read.name) else {
                continue;
            };
            let kind = ResourceKind::of_input(input.kind);
            match kinds[number].replace(kind) {
                Some(other) if other != kind => {
                    let problem = format!("is {other}, but pass `{}` reads it as {kind}", pass.name);
                    return Err(plan_error(plan, format!("input `{}`", read.from), problem));
                }
                _ => {}
            }
        }
    }
    Ok(kinds)
}

/// Uniforms by name, in whose types all passes must agree. The size of the frame is none of the caller's.
fn find_uniforms(plan: &ChainPlan, shaders: &[(&str, &Shader<'_>)], steps: &[Step]) -> Result<Vec<Uniform>, Error> {
    let mut uniforms: Vec<Uniform> = Vec::new();
    for (k, step) in steps.iter().enumerate() {
        let blocks = shaders[step.shader].1.plan.uniforms.iter();
        for field in blocks
            .flat_map(|block| block.fields.iter())
            .filter(|field| !field.frame_size)
        {
            let (name, ty) = (
                field.source_name(),
                field.part.as_ref().map_or(field.ty, |part| part.ty),
            );
            let Some(uniform) = uniforms.iter_mut().find(|uniform| uniform.name == name) else {
                uniforms.push(Uniform {
                    name: name.to_owned(),
                    ty,
                    passes: vec![k],
                });
                continue;
            };
            if uniform.ty != ty {
                let problem = format!(
                    "is of type {}, but of type {ty} in pass `{}`",
                    uniform.ty, plan.passes[k].name
                );
                return Err(plan_error(plan, format!("uniform `{name}`"), problem));
            }
            if uniform.passes.last() != Some(&k) {
                uniform.passes.push(k);
            }
        }
    }
    Ok(uniforms)
}
