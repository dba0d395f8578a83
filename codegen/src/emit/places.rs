//! Binding numbers and registers: the user's choices, and the lowest free ones for the rest.

use super::refusal::Refusal;
use crate::spec::EmitOptions;
use crate::spec::Target;
use crate::spec::{LAST_BINDING, LAST_GROUP, Parameters, Register};
use std::collections::BTreeMap;
use straightline_evaluator::shorten;
use straightline_evaluator::suggest_name;
use straightline_manifest::Stage;

/// An item that a shader binds.
#[derive(Clone, Debug)]
pub struct Named {
    /// Name in the shader.
    pub name: String,
    /// Register class in HLSL.
    pub class: char,
    /// `true` of immediates, which have a number in HLSL and MSL alone.
    pub immediate: bool,
}

/// Binding number of each resource, and the registers set by the user.
#[derive(Clone, Debug, Default)]
pub struct Places {
    group: u32,
    /// Binding number of each name.
    numbers: BTreeMap<String, u32>,
    /// The user's registers, by binding number, so that renaming does not affect them.
    registers: BTreeMap<u32, Register>,
}

impl Places {
    /// Assigns numbers to the `bound` items, in order; the last may be the sampler that only one language has. `outputs`
    /// are the shader's outputs, which a fragment shader does not bind. `sampler` is the name of the sampler that only GLSL
    /// 4.50 has.
    ///
    /// # Errors
    ///
    /// If a requested number or register is invalid.
    pub fn new(
        kernel: &str,
        options: &EmitOptions,
        bound: &[Named],
        outputs: &[String],
        sampler: &str,
    ) -> Result<Places, Refusal> {
        let refused = |what: String, help: String| Refusal::invalid_binding(kernel, &what, help);
        if options.is_function() {
            return match no_places(options) {
                None => Ok(Places::in_order(bound, sampler)),
                Some(option) => Err(refused(
                    format!("a function binds nothing, and {option} is given"),
                    "leave it out, or emit the form `entry`".to_owned(),
                )),
            };
        }
        if options.group > LAST_GROUP {
            return Err(refused(
                format!("the bind group {} is given", options.group),
                format!("bind groups are 0 to {LAST_GROUP}, of which devices promise 0 to 3"),
            ));
        }
        let mut places = Places {
            group: options.group,
            ..Places::default()
        };
        let unknown = |name: &str| unknown_name(options, bound, outputs, sampler, name);
        for (name, number) in &options.bindings {
            if let Some((what, help)) = unknown(name) {
                return Err(refused(what, help));
            }
            if *number > LAST_BINDING {
                return Err(refused(
                    format!("the binding number {number} is given to `{name}`"),
                    format!("binding numbers are 0 to {LAST_BINDING}"),
                )
                .about_input(name));
            }
            if let Some((other, _)) = places.numbers.iter().find(|(_, n)| *n == number)
                && other != name
            {
                return Err(refused(
                    format!("the binding number {number} is given to `{other}` and to `{name}`"),
                    "give each a number of its own".to_owned(),
                )
                .about_input(name));
            }
            if let Some(other) = places.numbers.insert(name.clone(), *number)
                && other != *number
            {
                return Err(refused(
                    format!("`{name}` is given the binding numbers {other} and {number}"),
                    "give it one".to_owned(),
                )
                .about_input(name));
            }
        }
        places.fill_numbers(bound, sampler);
        let registers = places.assign_registers(options, bound, sampler, &unknown);
        places.registers = registers.map_err(|(what, help)| refused(what, help))?;
        Ok(places)
    }

    fn in_order(bound: &[Named], sampler: &str) -> Places {
        let mut places = Places::default();
        places.fill_numbers(bound, sampler);
        places
    }

    /// Assigns the lowest free numbers to all items without one. Immediates may share that of the sampler that only GLSL 4.50
    /// has, where immediates have none: numbers are without gaps in every language.
    fn fill_numbers(&mut self, bound: &[Named], sampler: &str) {
        let mut next = 0;
        for Named { name, .. } in bound.iter().filter(|named| !named.immediate) {
            if !self.numbers.contains_key(name) {
                while self.numbers.values().any(|n| *n == next) {
                    next += 1;
                }
                self.numbers.insert(name.clone(), next);
                next += 1;
            }
        }
        for Named { name, .. } in bound.iter().filter(|named| named.immediate) {
            let is_free = |n: &u32| {
                self.numbers
                    .iter()
                    .all(|(other, number)| number != n || other == sampler)
            };
            let number = (0..).find(is_free).unwrap_or_default();
            self.numbers.insert(name.clone(), number);
        }
    }

    /// Assigns the user's registers.
    fn assign_registers(
        &self,
        options: &EmitOptions,
        bound: &[Named],
        sampler: &str,
        unknown: &dyn Fn(&str) -> Option<(String, String)>,
    ) -> Result<BTreeMap<u32, Register>, (String, String)> {
        let mut given = BTreeMap::new();
        if let Some((name, _)) = options.registers.first()
            && !options.targets.contains(&Target::Hlsl)
        {
            let what = format!("a register is given to `{}`, and HLSL is not written", shorten(name));
            return Err((what, "add the language hlsl, or leave the register out".to_owned()));
        }
        for (name, register) in &options.registers {
            if name == sampler {
                let what = format!("only GLSL 4.50 has the sampler `{sampler}`, and it has no registers");
                return Err((what, "leave the register out".to_owned()));
            }
            if let Some(error) = unknown(name) {
                return Err(error);
            }
            let class = bound.iter().find(|b| b.name == *name).map_or('t', |b| b.class);
            if class != register.class {
                let is = match class {
                    't' => "a texture or buffer that is read",
                    's' => "a sampler",
                    'u' => "written",
                    _ => "a uniform buffer",
                };
                let what = format!("the register {register} is given to `{name}`, which is {is}");
                return Err((what, format!("give it a register {class}{}", register.number)));
            }
            if register.number > LAST_BINDING || register.space.is_some_and(|space| space > LAST_GROUP) {
                let what = format!("the register {register} is given to `{name}`");
                return Err((
                    what,
                    format!("numbers are 0 to {LAST_BINDING}, and spaces 0 to {LAST_GROUP}"),
                ));
            }
            let space = Some(register.space.unwrap_or(self.group));
            let register = Register { space, ..*register };
            if given
                .insert(self.binding_number(name), register)
                .is_some_and(|other| other != register)
            {
                return Err((format!("`{name}` is given two registers"), "give it one".to_owned()));
            }
        }
        let in_hlsl = || bound.iter().filter(|b| b.name != sampler);
        let register = |b: &Named| {
            let number = self.binding_number(&b.name);
            let default = self.default_register(b.class, number);
            given.get(&number).copied().unwrap_or(default)
        };
        for (k, one) in in_hlsl().enumerate() {
            if let Some(other) = in_hlsl().take(k).find(|other| register(other) == register(one)) {
                let what = format!(
                    "`{}` and `{}` both get the register {}",
                    other.name,
                    one.name,
                    register(one)
                );
                let help =
                    "a register is that of the binding number unless one is given: give both a register".to_owned();
                return Err((what, help));
            }
        }
        Ok(given)
    }

    fn default_register(&self, class: char, number: u32) -> Register {
        let space = Some(self.group);
        Register { class, number, space }
    }

    /// Returns the bind group.
    pub fn bind_group(&self) -> u32 {
        self.group
    }

    /// Returns the binding number of a name.
    pub fn binding_number(&self, name: &str) -> u32 {
        self.numbers.get(name).copied().unwrap_or_default()
    }

    /// Returns the register at a binding number.
    pub fn register_at(&self, class: char, number: u32) -> Register {
        let default = self.default_register(class, number);
        self.registers.get(&number).copied().unwrap_or(default)
    }
}

/// Returns the first option that sets a place of a binding.
fn no_places(options: &EmitOptions) -> Option<String> {
    let binding = options
        .bindings
        .first()
        .map(|(name, _)| format!("a binding number of `{}`", shorten(name)));
    let register = options
        .registers
        .first()
        .map(|(name, _)| format!("a register of `{}`", shorten(name)));
    let group = (options.group != 0).then(|| format!("the bind group {}", options.group));
    let immediate = (options.parameters == Parameters::Immediate).then(|| "`parameters` as `immediate`".to_owned());
    binding.or(register).or(group).or(immediate)
}

/// Returns the error about a name that is not bound, and the remedy.
fn unknown_name(
    options: &EmitOptions,
    bound: &[Named],
    outputs: &[String],
    sampler: &str,
    name: &str,
) -> Option<(String, String)> {
    if bound.iter().any(|b| b.name == name) {
        return None;
    }
    if options.stage == Stage::Fragment
        && let Some(location) = outputs.iter().position(|output| *output == name)
    {
        let what = format!("`{name}` is the colour of a fragment shader, and has location {location}");
        return Some((what, "leave it out, or emit for compute".to_owned()));
    }
    if name == sampler && !options.targets.contains(&Target::Glsl450) {
        let what = format!("only GLSL 4.50 has the sampler `{sampler}`, and it is not written");
        return Some((what, "add the language glsl450, or leave it out".to_owned()));
    }
    let known: Vec<&str> = bound.iter().map(|b| b.name.as_str()).collect();
    let what = format!("the shader binds nothing called `{}`", shorten(name));
    Some((what, suggest_name(name, &known, "it binds")))
}
