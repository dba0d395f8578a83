//! Errors that are due to options set when the pipeline is created, whose values the text does not have.

use straightline_evaluator::diagnostic::{Code, Diagnostic, Errors};
use straightline_evaluator::ir::{Graph, Op};
use straightline_kernels::{OptionText, OptionValue, OptionValues};

/// Answer to whether a host can set an option when it creates the pipeline.
#[derive(Clone, Debug, PartialEq)]
pub enum Overridable {
    /// The shader takes the option then.
    Yes,
    /// It can, but the shader does not read the option.
    Unread,
    /// The text depends on the option: the error of overriding it, at the place that needs a constant.
    No(Box<Diagnostic>),
}

impl Overridable {
    /// The answer from compiling with the option overridden, which tells whether the shader reads it.
    pub(crate) fn from_outcome(reads: Result<bool, Errors>) -> Result<Overridable, Errors> {
        match reads {
            Ok(true) => Ok(Overridable::Yes),
            Ok(false) => Ok(Overridable::Unread),
            Err(errors) if errors.first_code() == Some(Code::CannotOverride) => {
                Ok(Overridable::No(Box::new(errors.diagnostics[0].clone())))
            }
            Err(errors) => Err(errors),
        }
    }
}

/// Returns whether a graph reads an override.
pub fn reads_override(graph: &Graph) -> bool {
    graph.nodes.iter().any(|node| matches!(node.op, Op::Override(_)))
}

/// Returns the errors of a kernel or chain with the options `texts`, whose values are `values`, so that each names the
/// override that it is due to: the option that alone makes `compile` fail. Other errors are returned as they are.
pub fn name_overrides(
    texts: &[OptionText],
    values: &OptionValues,
    errors: Errors,
    compile: &dyn Fn(Vec<OptionText>) -> Result<(), Errors>,
) -> Errors {
    let overrides: Vec<(&String, &OptionValue)> = values
        .iter()
        .filter_map(|(name, value)| match value {
            OptionValue::Override(default) => Some((name, &**default)),
            _ => None,
        })
        .collect();
    let with_constants = |kept: Option<&str>| {
        let spelled = texts.iter().map(|(name, text)| {
            let constant = overrides.iter().find(|(known, _)| *known == name && kept != Some(name));
            (
                name.clone(),
                constant.map_or(text.clone(), |(_, default)| default.to_string()),
            )
        });
        spelled.collect()
    };
    if overrides.is_empty() || compile(with_constants(None)).is_err() {
        return errors;
    }
    let mut found = Vec::new();
    for (name, _) in &overrides {
        for error in compile(with_constants(Some(name)))
            .err()
            .into_iter()
            .flat_map(|due| due.diagnostics)
        {
            let message = format!("the option `{name}` cannot be overridden: {}", error.message);
            let help = format!("leave `{name}` out of `override`, and emit a shader for each of its values");
            found.push(error.restated(Code::CannotOverride, message).help(help));
        }
    }
    match found.is_empty() {
        true => errors,
        false => Errors::new(found, &errors.files),
    }
}
