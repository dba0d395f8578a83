//! Parsing of uniforms and buffer elements from the command line.

use crate::failure::Failure;
use straightline_codegen::ir::{Element, Scalar, Type};
use straightline_codegen::shorten;

/// Parses the components of a uniform: one number each, or one for all of them.
pub fn parse_uniform(name: &str, ty: Type, text: &str) -> Result<Vec<f64>, Failure> {
    // A boolean is stored as a number.
    if let (true, Ok(set)) = (ty == Type::U32, text.parse::<bool>()) {
        return Ok(vec![f64::from(u8::from(set))]);
    }
    let numbers = parse_numbers(name, ty, text)?;
    let components = ty.component_count() as usize;
    if numbers.len() == components || numbers.len() == 1 {
        return Ok(numbers);
    }
    let takes = match components {
        1 => "one number".to_owned(),
        n => format!("{n} numbers, or one for all of them"),
    };
    Err(Failure::Usage(format!(
        "`{name}` is {} and takes {takes}, not {}",
        ty.in_rust(),
        numbers.len()
    )))
}

/// Parses the elements of a buffer. Structures list all their numbers in order, including those of vectors and arrays.
pub fn parse_buffer(name: &str, element: &Element, text: &str) -> Result<Vec<[f64; 4]>, Failure> {
    let types = element.value_types();
    let components = types.iter().map(|ty| ty.component_count() as usize).sum::<usize>();
    let texts = split_numbers(name, text)?;
    if !texts.len().is_multiple_of(components) {
        let held = match element {
            Element::Value(ty) => ty.in_rust(),
            Element::Struct(of) => format!("{} of {components} numbers", of.name),
        };
        return Err(Failure::Usage(format!(
            "`{name}` holds {held}, and {} numbers are no whole number of them",
            texts.len()
        )));
    }
    let mut rest = texts.into_iter();
    let mut values = Vec::new();
    let mut types = types.into_iter().cycle();
    while rest.len() > 0 {
        let ty = types.next().unwrap_or(Type::F32);
        let mut value = [0.0; 4];
        for (slot, text) in value.iter_mut().zip(rest.by_ref().take(ty.component_count() as usize)) {
            *slot = parse_number(name, ty, text)?;
        }
        values.push(value);
    }
    Ok(values)
}

/// Parses numbers separated by commas. Fails if a number does not fit a component of `ty`.
fn parse_numbers(name: &str, ty: Type, text: &str) -> Result<Vec<f64>, Failure> {
    let texts = split_numbers(name, text)?;
    texts.into_iter().map(|text| parse_number(name, ty, text)).collect()
}

/// Maximum count of numbers in a buffer.
const MOST: usize = 1 << 24;

/// Splits a list at commas; `0*256` repeats 0 256 times.
fn split_numbers<'t>(name: &str, text: &'t str) -> Result<Vec<&'t str>, Failure> {
    let mut texts = Vec::new();
    for part in text.split(',') {
        let (one, times) = match part.split_once('*') {
            Some((one, times)) => (one, times.trim().parse().ok().filter(|n| (1..=MOST).contains(n))),
            None => (part, Some(1)),
        };
        let times = times.filter(|n| texts.len() + n <= MOST).ok_or_else(|| {
            Failure::Usage(format!(
                "`{}` for `{name}` is no number so many times: write 0*256, of at most {MOST} numbers",
                shorten(part)
            ))
        })?;
        texts.extend(std::iter::repeat_n(one.trim(), times));
    }
    Ok(texts)
}

fn parse_number(name: &str, ty: Type, text: &str) -> Result<f64, Failure> {
    let refuse = |why: &str| Failure::Usage(format!("`{}` for `{name}` {why}", shorten(text)));
    let Ok(number) = text.parse::<f64>() else {
        return Err(refuse("is no list of numbers: write 1.5 or 1,2,3"));
    };
    let whole = |low: f64, high: f64, of: &str| {
        if number.fract() != 0.0 || !number.is_finite() {
            Err(refuse(&format!("is no whole number, and {of} holds no others")))
        } else if !(low..=high).contains(&number) {
            Err(refuse(&format!("does not fit into {of}, which holds {low} to {high}")))
        } else {
            Ok(number)
        }
    };
    match ty.scalar_kind() {
        Some(Scalar::I32) => whole(f64::from(i32::MIN), f64::from(i32::MAX), "an i32"),
        Some(Scalar::U32) => whole(0.0, f64::from(u32::MAX), "a u32"),
        _ if !number.is_finite() => Err(refuse("is not finite: give a number")),
        _ if !(number as f32).is_finite() => Err(refuse(&format!(
            "does not fit into an f32, which holds {:e} to {:e}",
            f32::MIN,
            f32::MAX
        ))),
        _ => Ok(number),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn usage_message(ty: Type, text: &str) -> String {
        match parse_uniform("n", ty, text) {
            Err(Failure::Usage(message)) => message,
            other => panic!("{text}: {other:?}"),
        }
    }

    #[test]
    fn numbers_that_do_not_fit_are_refused_with_what_they_are() {
        assert!(usage_message(Type::I32, "1.5").contains("`1.5` for `n` is no whole number"));
        assert!(usage_message(Type::U32, "-1").contains("does not fit into a u32, which holds 0 to 4294967295"));
        assert!(usage_message(Type::U32, "99999999999").contains("does not fit into a u32"));
        assert!(usage_message(Type::I32, "2147483648").contains("-2147483648 to 2147483647"));
        assert!(usage_message(Type::F32, "1e39").contains("does not fit into an f32"));
        assert!(usage_message(Type::F32, "NaN").contains("not finite"));
        assert!(usage_message(Type::F32, "1,2").contains("takes one number, not 2"));
        assert!(
            usage_message(Type::value(Scalar::F32, 3), "1,2")
                .contains("takes 3 numbers, or one for all of them, not 2")
        );
        let long = usage_message(Type::F32, &"x".repeat(100_000));
        assert!(long.len() < 300, "{long}");
        assert_eq!(parse_uniform("n", Type::U32, "4294967295").unwrap(), [4294967295.0]);
        assert_eq!(
            parse_uniform("n", Type::value(Scalar::I32, 2), " -1, 2 ").unwrap(),
            [-1.0, 2.0]
        );
        assert!(matches!(
            parse_buffer("b", &Element::Value(Type::U32), "1,-1"),
            Err(Failure::Usage(_))
        ));
        assert_eq!(parse_buffer("b", &Element::Value(Type::F32), "1,2").unwrap().len(), 2);
        assert_eq!(
            parse_buffer("b", &Element::Value(Type::U32), "7, 0*255").unwrap().len(),
            256
        );
        assert!(matches!(
            parse_buffer("b", &Element::Value(Type::U32), "0*x"),
            Err(Failure::Usage(_))
        ));
        assert!(matches!(
            parse_buffer("b", &Element::Value(Type::U32), "0*99999999999"),
            Err(Failure::Usage(_))
        ));
    }
}
