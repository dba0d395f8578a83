//! The function of a test as a kernel.

use super::arguments::{read_arguments, unsupported};
use super::picture::{draws_picture, kernel_of_picture, read_test_picture};
use super::{CASES, COUNTS, FLOATS, STATE, Test, WORDS};
use crate::diagnostic::Diagnostic;
use crate::front::token_span;
use proc_macro2::{Ident, Span, TokenStream, TokenTree};
use quote::{ToTokens, format_ident, quote_spanned};
use straightline_kernels::properties::{Argument, Component};
use syn::spanned::Spanned;

/// Lists the functions with the attribute `test`.
pub fn list_tests(file: u32, parsed: &syn::File) -> Vec<Test> {
    let mut tests = Vec::new();
    for_tests(&mut parsed.items.clone(), "", &mut |path, function| {
        tests.push(describe_test(file, path, function));
    });
    let all = parsed.to_token_stream();
    for test in &mut tests {
        let name = test.entry.clone();
        if definition_count(all.clone(), &name) > 1 {
            test.entry = format!("{}_test", test.path.replace("::", "_"));
        }
    }
    tests
}

/// Makes the function of a test a kernel. Its property is called with the case of the invocation.
pub fn make_kernel(parsed: &mut syn::File, test: &Test) {
    let mut at = None;
    for_tests(&mut parsed.items, "", &mut |path, function| {
        if path == test.path {
            at = Some(function.sig.ident.span());
            become_kernel(function, test);
        }
    });
    if let (Some(at), false) = (at, test.arguments.is_empty()) {
        let fields = test.arguments.iter().enumerate().map(|(k, (_, argument))| {
            let (name, ty) = (format_ident!("c{}", k, span = at), field_type(argument, at));
            quote_spanned!(at=> pub #name: #ty)
        });
        let case: syn::Result<syn::Item> =
            syn::parse2(quote_spanned!(at=> pub struct StraightlineCase { #(#fields),* }));
        parsed.items.extend(case);
    }
}

/// Calls `visit` with the path of each test and its function.
fn for_tests(items: &mut [syn::Item], prefix: &str, visit: &mut dyn FnMut(&str, &mut syn::ItemFn)) {
    for item in items {
        match item {
            syn::Item::Fn(function) if has_attribute(&function.attrs, "test") => {
                visit(&format!("{prefix}{}", function.sig.ident), function);
            }
            syn::Item::Mod(module) => {
                let prefix = format!("{prefix}{}::", module.ident);
                if let Some((_, items)) = &mut module.content {
                    for_tests(items, &prefix, visit);
                }
            }
            _ => {}
        }
    }
}

fn has_attribute(attrs: &[syn::Attribute], name: &str) -> bool {
    attrs.iter().any(|attr| attr.path().is_ident(name))
}

fn describe_test(file: u32, path: &str, function: &syn::ItemFn) -> Test {
    let (mut arguments, mut errors) = (Vec::new(), Vec::new());
    match property_arguments(file, function) {
        Ok(found) => arguments = found,
        Err(error) => errors.push(*error),
    }
    let mut picture = None;
    if draws_picture(function) {
        match read_test_picture(file, function) {
            Ok(found) => picture = Some(found),
            Err(error) => errors.push(*error),
        }
        if !arguments.is_empty() {
            let help = "write a test of its own for each";
            errors.push(*unsupported(
                file,
                &function.sig.ident,
                "a property and a picture in a test",
                help,
            ));
        }
    }
    Test {
        path: path.to_owned(),
        entry: function.sig.ident.to_string(),
        span: token_span(file, function.sig.ident.span()),
        arguments,
        picture,
        covered: false,
        ignored: has_attribute(&function.attrs, "ignore"),
        errors,
    }
}

/// The arguments of the property of a test.
fn property_arguments(file: u32, function: &syn::ItemFn) -> Result<Vec<(String, Argument)>, Box<Diagnostic>> {
    let refused = |at: &dyn ToTokens, what: &str, help: &str| Err(unsupported(file, &at.to_token_stream(), what, help));
    if let Some(attr) = function.attrs.iter().find(|attr| attr.path().is_ident("should_panic")) {
        return refused(
            attr,
            "`#[should_panic]`",
            "assert the opposite, or leave the test to `cargo test` by `#[ignore]`",
        );
    }
    let sig = &function.sig;
    if !sig.inputs.is_empty() || !sig.generics.params.is_empty() || sig.asyncness.is_some() {
        return refused(
            sig,
            "a test with parameters",
            "write `fn name()`, and `for_all(|x: f32| ..)` in it",
        );
    }
    if let syn::ReturnType::Type(_, ty) = &sig.output {
        return refused(ty, "a test with a result", "return nothing, and assert what must hold");
    }
    let mut found: Option<Vec<(String, Argument)>> = None;
    for statement in &function.block.stmts {
        let Some(call) = property_call(statement) else {
            if let Some(word) = mention_of_property(statement.to_token_stream()) {
                let help = "write it as a statement of the test itself: `for_all(|x: f32| ..);`";
                return refused(&word, &format!("`{word}` here"), help);
            }
            continue;
        };
        if found.is_some() {
            return refused(call, "a second property in a test", "write a test of its own for each");
        }
        let (ranges, closure) = match (is_ranged(call), call.args.iter().collect::<Vec<_>>().as_slice()) {
            (false, [closure]) => (None, *closure),
            (true, [ranges, closure]) => (Some(*ranges), *closure),
            _ => {
                return refused(
                    call,
                    "`for_all` with such arguments",
                    "write `for_all(|x: f32| ..)` or `for_all_in(0.0..1.0, |x: f32| ..)`",
                );
            }
        };
        let syn::Expr::Closure(closure) = closure else {
            return refused(closure, "a property that is no closure", "write `|x: f32| property(x)`");
        };
        found = Some(read_arguments(file, closure, ranges)?);
    }
    Ok(found.unwrap_or_default())
}

/// The call of `for_all` or `for_all_in` that a statement is.
fn property_call(statement: &syn::Stmt) -> Option<&syn::ExprCall> {
    let syn::Stmt::Expr(syn::Expr::Call(call), _) = statement else {
        return None;
    };
    property_name(call).map(|_| call)
}

fn property_name(call: &syn::ExprCall) -> Option<&Ident> {
    let syn::Expr::Path(path) = &*call.func else {
        return None;
    };
    let name = &path.path.segments.last()?.ident;
    is_property_name(name).then_some(name)
}

fn is_property_name(name: &Ident) -> bool {
    name == "for_all" || name == "for_all_in"
}

fn is_ranged(call: &syn::ExprCall) -> bool {
    property_name(call).is_some_and(|name| name == "for_all_in")
}

fn mention_of_property(tokens: TokenStream) -> Option<Ident> {
    tokens.into_iter().find_map(|token| match token {
        TokenTree::Group(group) => mention_of_property(group.stream()),
        TokenTree::Ident(word) if is_property_name(&word) => Some(word),
        _ => None,
    })
}

fn become_kernel(function: &mut syn::ItemFn, test: &Test) {
    let at = function.sig.ident.span();
    let names = ["test", "ignore", "should_panic"];
    function
        .attrs
        .retain(|attr| !names.iter().any(|name| attr.path().is_ident(name)));
    let entry = Ident::new(&test.entry, at);
    let [cases, counts, state, floats, words] = [CASES, COUNTS, STATE, FLOATS, WORDS].map(|name| Ident::new(name, at));
    let (given, load) = match test.arguments.is_empty() {
        true => (TokenStream::new(), TokenStream::new()),
        false => (
            quote_spanned!(at=> #cases: &Buffer<StraightlineCase>,),
            quote_spanned!(at=> let straightline_case = #cases.load((pixel.y * resolution.x as i32 + pixel.x) as usize);),
        ),
    };
    let [resources, statements, result] = match &test.picture {
        Some(picture) => kernel_of_picture(function, picture),
        None => {
            // A kernel writes something, also if all assertions are decided already.
            let mut statements = quote_spanned!(at=> #state.max(0, 0u32); #load);
            for statement in &function.block.stmts {
                match property_call(statement) {
                    Some(call) => statements.extend(property_of_case(call, &test.arguments)),
                    None => statement.to_tokens(&mut statements),
                }
            }
            [TokenStream::new(), statements, TokenStream::new()]
        }
    };
    let counts = test.covered.then(|| quote_spanned!(at=> #counts: &AtomicBuffer<u32>,));
    let attrs = &function.attrs;
    let kernel = quote_spanned!(at=>
        #(#attrs)*
        pub fn #entry(
            #given
            #resources
            #counts
            #state: &AtomicBuffer<u32>,
            #floats: &StorageBuffer<Vec4>,
            #words: &StorageBuffer<UVec4>,
            resolution: UVec2,
            pixel: IVec2,
        ) #result { #statements }
    );
    // The tokens between are those of statements that were parsed.
    if let Ok(kernel) = syn::parse2(kernel) {
        *function = kernel;
    }
}

/// Calls the closure of a property with the case.
fn property_of_case(call: &syn::ExprCall, arguments: &[(String, Argument)]) -> TokenStream {
    let at = call.func.span();
    let closure = call.args.last();
    let values = arguments.iter().enumerate().map(|(k, (_, argument))| {
        let field = format_ident!("c{}", k, span = at);
        match argument.component {
            Component::Bool => quote_spanned!(at=> straightline_case.#field != 0u32),
            _ => quote_spanned!(at=> straightline_case.#field),
        }
    });
    quote_spanned!(at=> { let straightline_property = #closure; straightline_property(#(#values),*); })
}

/// The type of a field that holds an argument.
fn field_type(argument: &Argument, at: Span) -> TokenStream {
    let (scalar, prefix) = match argument.component {
        Component::F32 => ("f32", ""),
        Component::I32 => ("i32", "I"),
        Component::U32 | Component::Bool => ("u32", "U"),
    };
    let name = match argument.width {
        1 => scalar.to_owned(),
        width => format!("{prefix}Vec{width}"),
    };
    let element = Ident::new(&name, at);
    match argument.elements {
        Some(len) => {
            let len = proc_macro2::Literal::usize_unsuffixed(len);
            quote_spanned!(at=> [#element; #len])
        }
        None => quote_spanned!(at=> #element),
    }
}

/// Number of functions of a name in tokens.
fn definition_count(tokens: TokenStream, name: &str) -> usize {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let is = |token: &TokenTree, text: &str| matches!(token, TokenTree::Ident(word) if word == text);
    let here = tokens
        .windows(2)
        .filter(|pair| is(&pair[0], "fn") && is(&pair[1], name))
        .count();
    let inside = tokens.iter().map(|token| match token {
        TokenTree::Group(group) => definition_count(group.stream(), name),
        _ => 0,
    });
    here + inside.sum::<usize>()
}
