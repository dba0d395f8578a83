//! Cases as Rust text.

use super::argument::{Argument, Component};

/// Returns statements that define the arguments of a case, one a line, as they may stand in a test.
pub fn case_text(arguments: &[(String, Argument)], case: &[u32]) -> Vec<String> {
    let mut rest = case;
    let mut lines = Vec::new();
    for (name, argument) in arguments {
        let (own, others) = rest.split_at(argument.component_count().min(rest.len()));
        rest = others;
        let value = match argument.elements {
            Some(_) => {
                let elements = own
                    .chunks(argument.width)
                    .map(|element| element_text(argument, element));
                format!("[{}]", elements.collect::<Vec<_>>().join(", "))
            }
            None => element_text(argument, own),
        };
        // A literal alone has no type yet.
        let ty = match (argument.elements, argument.width, argument.component) {
            (None, 1, Component::F32) => ": f32",
            (None, 1, Component::I32) => ": i32",
            (None, 1, Component::U32) => ": u32",
            _ => "",
        };
        lines.push(format!("let {name}{ty} = {value};"));
    }
    lines
}

fn element_text(argument: &Argument, element: &[u32]) -> String {
    let number = |bits: &u32| match argument.component {
        Component::F32 => float_text(f32::from_bits(*bits)),
        Component::I32 if *bits as i32 == i32::MIN => "i32::MIN".to_owned(),
        Component::I32 => (*bits as i32).to_string(),
        Component::U32 => bits.to_string(),
        Component::Bool => (*bits != 0).to_string(),
    };
    let prefix = match argument.component {
        Component::F32 => "",
        Component::I32 => "i",
        Component::U32 => "u",
        Component::Bool => "b",
    };
    match element {
        [one] => number(one),
        [first, others @ ..] if others.iter().all(|other| other == first) => {
            format!(
                "{}Vec{}::splat({})",
                prefix.to_uppercase(),
                element.len(),
                number(first)
            )
        }
        _ => {
            let numbers: Vec<String> = element.iter().map(number).collect();
            format!("{prefix}vec{}({})", element.len(), numbers.join(", "))
        }
    }
}

/// Returns a float as Rust text that has its bits.
pub fn float_text(x: f32) -> String {
    match x {
        _ if x.to_bits() == f32::NAN.to_bits() => "f32::NAN".to_owned(),
        _ if x.is_nan() => format!("f32::from_bits({:#x})", x.to_bits()),
        f32::INFINITY => "f32::INFINITY".to_owned(),
        f32::NEG_INFINITY => "f32::NEG_INFINITY".to_owned(),
        f32::MAX => "f32::MAX".to_owned(),
        f32::MIN => "f32::MIN".to_owned(),
        f32::MIN_POSITIVE => "f32::MIN_POSITIVE".to_owned(),
        _ => format!("{x:?}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_are_statements() {
        let array = Argument {
            elements: Some(2),
            ..Argument::new(Component::F32, 1)
        };
        let arguments = [
            ("tau".to_owned(), Argument::new(Component::F32, 1)),
            ("uv".to_owned(), Argument::new(Component::F32, 2)),
            ("at".to_owned(), Argument::new(Component::I32, 2)),
            ("on".to_owned(), Argument::new(Component::Bool, 1)),
            ("taps".to_owned(), array),
        ];
        let floats = |values: &[f32]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        let case = [
            floats(&[-0.0, 1.0, 1.0]),
            vec![3, -4i32 as u32, 1],
            floats(&[1e-40, f32::NAN]),
        ]
        .concat();
        assert_eq!(
            case_text(&arguments, &case),
            [
                "let tau: f32 = -0.0;",
                "let uv = Vec2::splat(1.0);",
                "let at = ivec2(3, -4);",
                "let on = true;",
                "let taps = [1e-40, f32::NAN];",
            ]
        );
    }
}
