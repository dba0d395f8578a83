//! Choice of the kernel among a file's functions, if the caller names none.

use super::chain::returns_pictures;
use super::foreign::is_resource;
use super::raw::unraw;
use crate::diagnostic::{Code, Diagnostic};
use std::collections::BTreeSet;

/// Returns the kernel of a text if the caller names none: the public function called `wanted` with parameters and a result that a kernel
/// can have, or else the only such function. Functions that read a resource or take a pixel take precedence over those with numbers alone.
///
/// # Errors
///
/// If several functions could be meant, or none. `path` is that of the file, for the help.
pub fn kernel_of(text: &str, wanted: &str, path: &str) -> Result<String, Box<Diagnostic>> {
    let text = super::without_head(text);
    // Text that is no Rust is reported with its place when the kernel is read.
    if super::depth::check_depth(0, &text).is_err() {
        return Ok(wanted.to_owned());
    }
    let Ok(file) = super::raw::parse_file(&text) else {
        return Ok(wanted.to_owned());
    };
    let of_resources = structures_of_resources(&file.items);
    let functions: Vec<&syn::ItemFn> = file
        .items
        .iter()
        .filter_map(|item| match item {
            syn::Item::Fn(function) => Some(function),
            _ => None,
        })
        .collect();
    let public = functions.iter().filter(|f| is_public(f));
    let (mut of_pixels, mut of_numbers) = (Vec::new(), Vec::new());
    for function in public {
        match classify_inputs(&function.sig, &of_resources) {
            Takes::Pixel => of_pixels.push(&function.sig.ident),
            Takes::Numbers => of_numbers.push(&function.sig.ident),
            Takes::Other => {}
        }
    }
    let name = |ident: &syn::Ident| unraw(&ident.to_string()).to_owned();
    if of_pixels.iter().chain(&of_numbers).any(|ident| name(ident) == wanted) {
        return Ok(wanted.to_owned());
    }
    let found = if of_pixels.is_empty() { of_numbers } else { of_pixels };
    let [first, others @ ..] = found.as_slice() else {
        return Err(Box::new(no_kernel(&functions, wanted, path)));
    };
    if others.is_empty() {
        return Ok(name(first));
    }
    let names: Vec<String> = found.iter().map(|ident| format!("`{}`", name(ident))).collect();
    let what = format!(
        "`{path}` has several functions that may be its kernel: {}",
        names.join(", ")
    );
    let mut error = Diagnostic::error_at(Code::UnknownKernel, super::token_span(0, first.span()), what)
        .label("one of them")
        .help(format!("name one of them: `{path}::{}`", name(first)));
    for other in others {
        error = error.label_at(super::token_span(0, other.span()), "another");
    }
    Err(Box::new(error))
}

/// The error of a file that has no kernel.
fn no_kernel(functions: &[&syn::ItemFn], wanted: &str, path: &str) -> Diagnostic {
    let what = format!("`{path}` has no public function that takes and gives what a kernel does");
    let private = functions
        .iter()
        .find(|f| unraw(&f.sig.ident.to_string()) == wanted && !is_public(f));
    match private {
        Some(function) => Diagnostic::error_at(
            Code::UnknownKernel,
            super::token_span(0, function.sig.ident.span()),
            what,
        )
        .label("private")
        .help(format!(
            "write `pub fn {wanted}`, or name the function: `{path}::{wanted}`"
        )),
        None if functions.iter().any(|function| returns_pictures(&function.sig)) => {
            Diagnostic::new(Code::UnknownKernel, what).help(
                "its functions draw pictures, and are chains of passes: `emit`, `run`, `check` and `explain` take them",
            )
        }
        None => Diagnostic::new(Code::UnknownKernel, what)
            .help("a kernel is a function such as `pub fn NAME(color: &Frame<Vec4>, pixel: IVec2) -> Vec4`"),
    }
}

fn is_public(function: &syn::ItemFn) -> bool {
    matches!(function.vis, syn::Visibility::Public(_))
}

/// Class of a function by its parameters.
enum Takes {
    /// Values of a pixel: resources, a pixel, a workgroup.
    Pixel,
    /// Numbers alone.
    Numbers,
    /// Parameters or a result that no kernel has.
    Other,
}

fn classify_inputs(signature: &syn::Signature, of_resources: &BTreeSet<String>) -> Takes {
    let mut of_pixel = false;
    for input in &signature.inputs {
        let syn::FnArg::Typed(input) = input else {
            return Takes::Other;
        };
        if matches!(&*input.pat, syn::Pat::Ident(name) if name.ident == "pixel") {
            of_pixel = true;
        }
        let Some(name) = type_name(&input.ty) else {
            return Takes::Other;
        };
        of_pixel |= is_resource(&name) || name == "Workgroup" || name == "Quad" || of_resources.contains(&name);
    }
    let gives = match &signature.output {
        syn::ReturnType::Default => of_pixel,
        syn::ReturnType::Type(_, ty) => is_result(ty),
    };
    match (gives && signature.generics.params.is_empty(), of_pixel) {
        (false, _) => Takes::Other,
        (true, true) => Takes::Pixel,
        (true, false) => Takes::Numbers,
    }
}

/// The name of a type that a kernel may take; `None` of one that it may not.
fn type_name(ty: &syn::Type) -> Option<String> {
    match ty {
        syn::Type::Reference(reference) if reference.mutability.is_none() => type_name(&reference.elem),
        syn::Type::Path(path) => path.path.segments.last().map(|segment| segment.ident.to_string()),
        syn::Type::Array(array) => type_name(&array.elem),
        _ => None,
    }
}

/// Returns whether a kernel may return a value of a type: numbers, or a structure or tuple of them.
fn is_result(ty: &syn::Type) -> bool {
    match ty {
        syn::Type::Tuple(tuple) => tuple.elems.iter().all(is_result),
        syn::Type::Path(path) => path.path.segments.last().is_some_and(|segment| {
            let name = segment.ident.to_string();
            !is_resource(&name)
                && !matches!(name.as_str(), "bool" | "usize" | "Option" | "Result")
                && !name.starts_with("Mat")
        }),
        _ => false,
    }
}

/// The structures with a field that is a resource.
fn structures_of_resources(items: &[syn::Item]) -> BTreeSet<String> {
    let structures = items.iter().filter_map(|item| match item {
        syn::Item::Struct(structure) => Some(structure),
        _ => None,
    });
    let holds = |structure: &&syn::ItemStruct| {
        let mut fields = structure.fields.iter();
        fields.any(|field| type_name(&field.ty).is_some_and(|name| is_resource(&name)))
    };
    structures
        .filter(holds)
        .map(|structure| structure.ident.to_string())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::kernel_of;

    fn find_kernel(text: &str) -> Result<String, String> {
        kernel_of(text, "blur", "blur.rs")
            .map_err(|error| format!("{} | {}", error.message, error.help.unwrap_or_default()))
    }

    #[test]
    fn a_private_helper_of_the_files_name_is_no_kernel() {
        let text = "fn blur(c: Vec4) -> Vec4 { c }\npub fn main_pass(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 { blur(color.load(pixel)) }";
        assert_eq!(find_kernel(text), Ok("main_pass".to_owned()));
    }

    #[test]
    fn public_helpers_are_no_kernels_beside_one_of_pixels() {
        let kernel = "pub fn pass(inputs: &Inputs, pixel: IVec2) -> Vec4 { todo!() }";
        let helpers = "pub fn blur(a: &mut [f32; 8]) {}\npub fn luma(c: Vec3) -> f32 { c.x }\npub fn g<T>(t: T, pixel: IVec2) -> f32 { 0.0 }";
        assert_eq!(find_kernel(&format!("{helpers}\n{kernel}")), Ok("pass".to_owned()));
        let nested = "mod inside { pub fn other(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 { color.load(pixel) } }";
        assert_eq!(find_kernel(&format!("{nested}\n{kernel}")), Ok("pass".to_owned()));
        assert_eq!(
            find_kernel("pub fn solid(gain: f32) -> Vec4 { Vec4::splat(gain) }"),
            Ok("solid".to_owned())
        );
    }

    #[test]
    fn the_files_name_tells_kernels_apart() {
        let two = "pub fn blur(a: &Frame<f32>, pixel: IVec2) -> f32 { 0.0 }\npub fn sharp(a: &Frame<f32>, pixel: IVec2) -> f32 { 0.0 }";
        assert_eq!(find_kernel(two), Ok("blur".to_owned()));
        let others = two.replace("fn blur", "fn soft");
        let error = "`blur.rs` has several functions that may be its kernel: `soft`, `sharp` | name one of them: `blur.rs::soft`";
        assert_eq!(find_kernel(&others), Err(error.to_owned()));
    }

    #[test]
    fn a_file_without_a_kernel_is_told_so() {
        let private = find_kernel("fn blur(a: &Frame<f32>, pixel: IVec2) -> f32 { 0.0 }").unwrap_err();
        assert!(private.contains("write `pub fn blur`"), "{private}");
        let none = find_kernel("pub struct A;").unwrap_err();
        assert!(none.contains("no public function"), "{none}");
        // The parser says more of what is no Rust.
        assert_eq!(find_kernel("pub fn ("), Ok("blur".to_owned()));
    }
}
