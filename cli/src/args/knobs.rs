//! The knobs of a shader as command-line arguments: one for each knob that the generator declares.

use clap::builder::TypedValueParser;
use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches, ValueHint};
use std::ffi::OsStr;
use straightline_codegen::spec::{Arity, KNOBS, Knob, Overrides, Part};
use straightline_codegen::{Settings, ShaderSpec};

/// Arguments for the knobs of a shader's computation.
pub type SettingsArgs = KnobArgs<false>;

/// Arguments for the knobs of a shader's text.
pub type WritingArgs = KnobArgs<true>;

/// An argument for each knob of one half of a shader's description.
#[derive(Debug, Clone, Default)]
pub struct KnobArgs<const WRITING: bool>(pub Overrides);

impl<const WRITING: bool> KnobArgs<WRITING> {
    fn knobs() -> impl Iterator<Item = &'static Knob> {
        let half = if WRITING { Part::EmitOptions } else { Part::Settings };
        KNOBS.iter().filter(move |knob| knob.part == half)
    }
}

impl SettingsArgs {
    pub fn settings(&self) -> Settings {
        self.0.apply(ShaderSpec::new()).settings
    }

    /// Returns the description of the shader whose text `writing` configures.
    pub fn shader_spec(&self, writing: &WritingArgs) -> ShaderSpec {
        writing.0.apply(self.0.apply(ShaderSpec::new()))
    }
}

impl<const WRITING: bool> Args for KnobArgs<WRITING> {
    fn augment_args(command: Command) -> Command {
        Self::knobs().fold(command, |command, knob| command.arg(knob_argument(knob)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<const WRITING: bool> FromArgMatches for KnobArgs<WRITING> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut given = KnobArgs::default();
        given.update_from_arg_matches(matches)?;
        Ok(given)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        for knob in Self::knobs() {
            if matches.value_source(knob.name) != Some(ValueSource::CommandLine) {
                continue;
            }
            let texts = match knob.arity {
                Arity::Flag => vec!["true".to_owned()],
                _ => matches
                    .get_many::<String>(knob.name)
                    .into_iter()
                    .flatten()
                    .cloned()
                    .collect(),
            };
            let set = self.0.set(knob.name, texts);
            // Each value was already checked on its own.
            set.map_err(|why| Error::raw(ErrorKind::ValueValidation, format!("--{}: {why}\n", knob.name)))?;
        }
        Ok(())
    }
}

/// Builds the argument of a knob.
fn knob_argument(knob: &'static Knob) -> Arg {
    let argument = Arg::new(knob.name).long(knob.name).help(knob.help());
    let argument = match knob.part {
        Part::Settings => argument.help_heading("Kernel options"),
        Part::EmitOptions => argument,
    };
    if knob.arity == Arity::Flag {
        return argument.action(ArgAction::SetTrue);
    }
    let action = match knob.arity {
        Arity::Many => ArgAction::Append,
        _ => ArgAction::Set,
    };
    let default = knob.value_texts(&ShaderSpec::new()).join(",");
    let argument = argument
        .value_name(knob.value)
        .action(action)
        .value_parser(Checked(knob));
    // Prevents clap from guessing a hint from names such as `--entry`.
    let argument = argument.value_hint(ValueHint::Other);
    match default.is_empty() {
        true => argument,
        false => argument.default_value(default),
    }
}

/// Parser for one value of a knob, so that an error names the argument and its value.
#[derive(Clone)]
struct Checked(&'static Knob);

impl TypedValueParser for Checked {
    type Value = String;

    fn parse_ref(&self, command: &Command, argument: Option<&Arg>, value: &OsStr) -> Result<String, Error> {
        let knob = self.0;
        let read = |text: &str| knob.set(&mut ShaderSpec::new(), &[text]).map(|()| text.to_owned());
        TypedValueParser::parse_ref(&read, command, argument, value)
    }
}
