//! Maps a kernel's inputs to what an engine has, by meaning.

use crate::description::Description;
use crate::fits::Misfit;
use crate::meaning::{Holds, MEANINGS, Meaning, OWN, is_flat};
use std::collections::BTreeMap;
use straightline_manifest::{BindingKind, Dimension, Manifest, SampleType, UniformField, ValueType};

/// The inputs that an engine itself provides, by their names in the kernel; all others are the user's.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    bound: BTreeMap<String, &'static Meaning>,
    /// Inputs that the request declares to be the user's own.
    own: Vec<String>,
}

/// An input of a kernel.
struct Input<'a> {
    name: &'a str,
    ty: InputType,
    /// Without a request of the user, its name alone can give it a meaning.
    named: bool,
}

enum InputType {
    Texture(Dimension, SampleType, u8),
    /// Type of a field, and whether it is a column of a matrix.
    Uniform(ValueType, bool),
}

impl Input<'_> {
    fn has_type(&self, holds: Holds) -> bool {
        match self.ty {
            InputType::Texture(dimension, sample_type, components) => {
                holds.fits_texture(dimension, sample_type, components)
            }
            InputType::Uniform(ty, is_column) => holds.fits_uniform(ty, is_column),
        }
    }

    fn is_texture(&self) -> bool {
        matches!(self.ty, InputType::Texture(..))
    }

    /// Returns whether an engine could render to it.
    fn is_flat(&self) -> bool {
        matches!(self.ty, InputType::Texture(dimension, sample_type, _) if is_flat(dimension, sample_type))
    }
}

impl Inputs {
    /// Finds the meaning of each input: by `binds`, else by its name and type. An engine that declares no meanings binds
    /// every input by its own name.
    ///
    /// # Errors
    ///
    /// The first input whose meaning the engine does not have, or that has another type, with the option that settles it.
    pub fn resolve(
        manifest: &Manifest,
        description: &Description,
        binds: &BTreeMap<String, String>,
    ) -> Result<Inputs, Misfit> {
        let all = inputs_of(manifest);
        let title = &description.title;
        if let Some((name, word)) = binds
            .iter()
            .find(|(name, _)| !all.iter().any(|input| input.name == *name))
        {
            let names: Vec<String> = all.iter().map(|input| format!("`{}`", input.name)).collect();
            let why = format!("does not read `{name}`, which `--bind {name}={word}` binds");
            return Err(Misfit::new(why).help(format!("its inputs are {}", names.join(", "))));
        }
        if description.meanings.is_empty() {
            return match binds.iter().find(|(_, word)| *word != OWN) {
                Some((name, word)) => Err(Misfit::of_input(
                    name,
                    format!("binds `{name}` as `{word}`, and {title} takes every input by its own name"),
                )
                .help("leave `--bind` out".to_owned())),
                None => Ok(Inputs::default()),
            };
        }
        let mut inputs = Inputs::default();
        for input in &all {
            inputs.bind(input, description, binds.get(input.name).map(String::as_str))?;
        }
        Ok(inputs)
    }

    fn bind(&mut self, input: &Input<'_>, description: &Description, word: Option<&str>) -> Result<(), Misfit> {
        let (name, title) = (input.name, &description.title);
        if word == Some(OWN) {
            self.own.push(name.to_owned());
            return Ok(());
        }
        let meaning = match word {
            Some(word) => Some(Meaning::find(word).ok_or_else(|| {
                let known: Vec<&str> = MEANINGS.iter().map(|meaning| meaning.name).collect();
                Misfit::of_input(name, format!("binds `{name}` as `{word}`, which is no meaning"))
                    .help(format!("the meanings are {}, and {OWN}", known.join(", ")))
            })?),
            // Arrays, volumes and tables of integers are no render targets, so their names do not count.
            None if !input.named || (input.is_texture() && !input.is_flat()) => None,
            None => Meaning::of_input(name),
        };
        let Some(meaning) = meaning else { return Ok(()) };
        let own = format!("`--bind {name}={OWN}` makes it an input that you set");
        if !input.has_type(meaning.holds) {
            let (word, declared) = (meaning.name, meaning.holds.declared());
            let why = format!("reads `{name}` as {word}, which is no input of its type");
            let help = format!("declare `{name}: {declared}`");
            return Err(
                Misfit::of_input(name, why).help(match description.binds_own(input.is_texture()) {
                    true => format!("{help}; {own}"),
                    false => help,
                }),
            );
        }
        if !description.meanings.contains_key(meaning.name) {
            let doc = meaning.doc.trim_end_matches('.');
            let reason = description.lacks.get(meaning.name);
            let reason = reason.map_or(String::new(), |reason| format!(": {reason}"));
            let why = format!("reads `{name}`, and {title} has no {}{reason}", meaning.name);
            let misfit = Misfit::of_input(name, why);
            let help = format!("{} is: {}", meaning.name, lower_first(doc));
            return Err(misfit.help(match description.binds_own(input.is_texture()) {
                true => format!("{own}; {help}"),
                false => help,
            }));
        }
        if let Some((other, _)) = self.bound.iter().find(|(_, known)| **known == meaning) {
            if other == name {
                return Ok(());
            }
            let why = format!("reads both `{other}` and `{name}` as {}", meaning.name);
            return Err(Misfit::of_input(name, why).help(own));
        }
        self.bound.insert(name.to_owned(), meaning);
        Ok(())
    }

    /// Returns the reason why a texture of the user's cannot be bound, or why the picture is unknown.
    pub fn find_unknown(&self, manifest: &Manifest, description: &Description) -> Option<Misfit> {
        let has_picture = description.meanings.contains_key("color");
        let title = &description.title;
        let textures = inputs_of(manifest).into_iter().filter(Input::is_texture);
        let unknown: Vec<Input<'_>> = textures.filter(|input| self.meaning(input.name).is_none()).collect();
        let is_own = |input: &&Input<'_>| self.own.iter().any(|own| own == input.name);
        let knows_picture = self.bound.values().any(|meaning| meaning.is_picture());
        if has_picture
            && !knows_picture
            && let Some(input) = unknown.iter().find(|input| input.is_flat() && !is_own(input))
        {
            let name = input.name;
            let why = format!("reads `{name}`, and its name does not say which of {title}'s textures that is");
            let own = match description.binds_own(true) {
                true => format!("; `--bind {name}={OWN}` makes it a texture that you set"),
                false => String::new(),
            };
            let help = format!("`--bind {name}=color` makes it the picture{own}");
            return Some(Misfit::of_input(name, why).help(help));
        }
        let input = unknown.first().filter(|_| !description.binds_own(true))?;
        let name = input.name;
        let known: Vec<&str> = MEANINGS
            .iter()
            .filter(|meaning| meaning.holds.is_texture() && description.meanings.contains_key(meaning.name))
            .map(|meaning| meaning.name)
            .collect();
        let why = format!(
            "reads `{name}`, a texture of yours, and {title} binds none but {}",
            known.join(", ")
        );
        Some(Misfit::of_input(name, why))
    }

    /// Returns the meaning of an input, or of the matrix that it is a column of.
    pub fn meaning(&self, input: &str) -> Option<&'static Meaning> {
        self.bound.get(input).copied()
    }

    /// Returns the meaning of a uniform's field.
    pub fn field_meaning(&self, field: &UniformField) -> Option<&'static Meaning> {
        self.meaning(whole_name(field))
    }

    /// Returns whether an input is a texture that the engine converts for the kernel, texel by texel.
    pub fn is_converted(&self, input: &str) -> bool {
        self.meaning(input)
            .is_some_and(|meaning| meaning.holds.is_texture() && !meaning.is_picture())
    }

    /// Iterates over the inputs that the engine provides, and their meanings.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &'static Meaning)> {
        self.bound.iter().map(|(name, meaning)| (name.as_str(), *meaning))
    }
}

/// Returns the name of a uniform, or of the matrix or array that it is a part of.
pub fn whole_name(field: &UniformField) -> &str {
    field.part.as_ref().map_or(&field.name, |part| &part.of)
}

fn inputs_of(manifest: &Manifest) -> Vec<Input<'_>> {
    let mut all = Vec::new();
    for binding in &manifest.bindings {
        match &binding.kind {
            BindingKind::Texture {
                dimension,
                sample_type,
                components,
                ..
            } => all.push(Input {
                name: &binding.name,
                ty: InputType::Texture(*dimension, *sample_type, *components),
                named: true,
            }),
            BindingKind::Uniform { fields, .. } if !binding.is_region() => {
                let fields = fields.iter().filter(|field| !field.frame_size);
                all.extend(fields.map(|field| {
                    let part = field.part.as_ref();
                    let is_column = part.is_some_and(|part| matches!(part.ty, ValueType::Matrix { .. }));
                    Input {
                        name: whole_name(field),
                        ty: InputType::Uniform(field.ty, is_column),
                        // An option has a value of its own, and parts of structures have the names of their fields.
                        named: field.default.is_none(),
                    }
                }));
            }
            _ => {}
        }
    }
    all
}

fn lower_first(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_lowercase().collect::<String>() + letters.as_str()
    })
}
