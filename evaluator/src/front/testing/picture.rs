//! Pictures of tests: what `assert_picture` draws, and the textures and samplers that the test makes for it.

use super::arguments::unsupported;
use super::literals::{called, likeness_of, sampler_of, size_of, text_of};
use crate::diagnostic::{Diagnostic, Span};
use crate::front::cfg::as_written;
use crate::front::token_span;
use crate::interp::SamplerState;
use proc_macro2::{Group, Ident, TokenStream, TokenTree};
use quote::{ToTokens, quote_spanned};
use straightline_kernels::pictures::{Likeness, MAX_PIXELS, MAX_SIDE, is_size, name_error};
use syn::spanned::Spanned;

type Refused<T> = Result<T, Box<Diagnostic>>;

/// A picture that a test draws, to compare it with a file or to read it.
#[derive(Clone, Debug)]
pub struct TestPicture {
    /// Variable that holds it; `None` of the one that is compared.
    pub variable: Option<String>,
    /// Name of the golden file, beside the kernel's file; empty if it is not compared.
    pub golden: String,
    /// Place of that name, or of the call of `draw`.
    pub span: Span,
    /// Width and height.
    pub size: [u32; 2],
    /// Greatest difference that the test takes.
    pub likeness: Likeness,
    /// Textures that it reads.
    pub images: Vec<TestImage>,
    /// Samplers by name.
    pub samplers: Vec<(String, SamplerState)>,
}

/// A texture of a test.
#[derive(Clone, Debug)]
pub struct TestImage {
    /// Name of the variable, and of the texture.
    pub name: String,
    /// Origin of its texels.
    pub source: ImageSource,
}

/// Origin of the texels of a texture.
#[derive(Clone, Debug)]
pub enum ImageSource {
    /// A file.
    File {
        /// Its name, beside the kernel's file.
        name: String,
        /// Place of that name.
        span: Span,
        /// `true` if its numbers are taken as they are, not as colours in sRGB.
        data: bool,
    },
    /// Another kernel of the test.
    Drawn(Box<TestPicture>),
}

/// A statement of a test that draws a picture.
enum Statement<'s> {
    /// `let image: Texture<Vec4> = read_picture("chart.png");`
    Read(TestImage, &'s syn::Type),
    /// `let image: Texture<Vec4> = draw(uvec2(64, 36), |pixel| ...);`
    Draw(&'s Ident, &'s syn::Type, &'s syn::ExprCall),
    /// `let linear = Sampler::default();`
    Sampler(Ident, SamplerState),
    /// `assert_picture("golden.png", uvec2(64, 36), |pixel| ..., psnr(50.0));`
    Assert(&'s syn::ExprCall),
    /// Another one, of the kernel language.
    Other,
}

/// Returns whether a function calls `assert_picture`.
pub fn draws_picture(function: &syn::ItemFn) -> bool {
    has_word(function.block.to_token_stream(), "assert_picture")
}

/// Reads the picture of a test.
pub fn read_test_picture(file: u32, function: &syn::ItemFn) -> Refused<TestPicture> {
    let mut found: Option<TestPicture> = None;
    let (mut images, mut samplers) = (Vec::new(), Vec::new());
    for statement in &function.block.stmts {
        match read_statement(file, statement)? {
            Statement::Read(image, _) => images.push(image),
            Statement::Sampler(name, state) => samplers.push((name.to_string(), state)),
            Statement::Draw(name, _, call) => {
                let [size, closure] = call.args.iter().collect::<Vec<_>>()[..] else {
                    let help = "write `draw(uvec2(64, 36), |pixel| color(pixel))`";
                    return Err(unsupported(file, call, "`draw` with such arguments", help));
                };
                check_closure(file, closure)?;
                let drawn = TestPicture {
                    variable: Some(name.to_string()),
                    golden: String::new(),
                    span: token_span(file, call.span()),
                    size: read_size(file, function, size)?,
                    likeness: Likeness::Exact,
                    images: images.clone(),
                    samplers: samplers.clone(),
                };
                images.push(TestImage {
                    name: name.to_string(),
                    source: ImageSource::Drawn(Box::new(drawn)),
                });
            }
            Statement::Assert(call) if found.is_some() => {
                let help = "write a test of its own for each";
                return Err(unsupported(file, call, "a second picture in a test", help));
            }
            Statement::Assert(call) => found = Some(read_call(file, function, call)?),
            Statement::Other => refuse_words(file, statement)?,
        }
    }
    match found {
        Some(picture) => Ok(TestPicture {
            images,
            samplers,
            ..picture
        }),
        None => {
            let help = "write it as a statement of the test itself";
            Err(unsupported(file, &function.sig.ident, "`assert_picture` here", help))
        }
    }
}

/// Parameters, statements and result of the kernel that draws a picture of a test.
pub fn kernel_of_picture(function: &syn::ItemFn, picture: &TestPicture) -> [TokenStream; 3] {
    let at = function.sig.ident.span();
    let (mut parameters, mut body) = (TokenStream::new(), TokenStream::new());
    let mut resources = Vec::new();
    for statement in &function.block.stmts {
        let closure = match read_statement(0, statement) {
            Ok(Statement::Read(image, ty)) => {
                let name = Ident::new(&image.name, at);
                parameters.extend(quote_spanned!(at=> #name: &#ty,));
                resources.push(image.name);
                None
            }
            Ok(Statement::Sampler(name, _)) => {
                parameters.extend(quote_spanned!(at=> #name: &Sampler,));
                resources.push(name.to_string());
                None
            }
            Ok(Statement::Draw(name, _, call)) if picture.variable.as_ref().is_some_and(|own| name == own) => {
                call.args.iter().nth(1)
            }
            Ok(Statement::Draw(name, ty, _)) => {
                parameters.extend(quote_spanned!(at=> #name: &#ty,));
                resources.push(name.to_string());
                None
            }
            Ok(Statement::Assert(call)) => call.args.iter().nth(2),
            _ => {
                statement.to_tokens(&mut body);
                None
            }
        };
        if let Some(closure) = closure {
            // Inference knows calls by their places: this one must not have that of `into_color`.
            body.extend(quote_spanned!(at=> let straightline_shade = #closure;));
            body.extend(quote_spanned!(function.sig.fn_token.span=>
                let straightline_color = straightline_shade(straightline_pixel);
            ));
            // Statements behind the drawing of a texture are of the pictures that read it.
            if picture.variable.is_some() {
                break;
            }
        }
    }
    let body = without_borrows(body, &resources);
    [
        parameters,
        quote_spanned!(at=> let straightline_pixel = pixel; #body straightline_color.into_color()),
        quote_spanned!(at=> -> Vec4),
    ]
}

fn read_statement(file: u32, statement: &syn::Stmt) -> Refused<Statement<'_>> {
    let refused = |at: &dyn ToTokens, what: &str, help: &str| Err(unsupported(file, &at.to_token_stream(), what, help));
    let local = match statement {
        syn::Stmt::Expr(syn::Expr::Call(call), _) if called(call).is_some_and(|name| name == "assert_picture") => {
            return Ok(Statement::Assert(call));
        }
        syn::Stmt::Local(local) => local,
        _ => return Ok(Statement::Other),
    };
    let Some(init) = &local.init else {
        return Ok(Statement::Other);
    };
    let (pattern, ty) = match &local.pat {
        syn::Pat::Type(typed) => (&*typed.pat, Some(&*typed.ty)),
        pattern => (pattern, None),
    };
    if let syn::Expr::Call(call) = &*init.expr
        && let Some(by) = called(call).filter(|name| {
            ["read_picture", "read_linear", "draw"]
                .iter()
                .any(|known| name == known)
        })
    {
        let (syn::Pat::Ident(name), Some(ty)) = (pattern, ty) else {
            let help = format!(
                "write its type: `let image: Texture<Vec4> = {};`",
                as_written(&init.expr)
            );
            return refused(local, "a picture without a type", &help);
        };
        if by == "draw" {
            return Ok(Statement::Draw(&name.ident, ty, call));
        }
        let Some((text, span)) = call.args.first().and_then(|arg| text_of(file, arg)) else {
            let help = "write `read_picture(\"chart.png\")`";
            return refused(call, "a picture whose name is not written out", help);
        };
        check_name(file, call, &text)?;
        let image = TestImage {
            name: name.ident.to_string(),
            source: ImageSource::File {
                name: text,
                span,
                data: by == "read_linear",
            },
        };
        return Ok(Statement::Read(image, ty));
    }
    if has_word(init.expr.to_token_stream(), "Sampler") {
        let state = sampler_of(&init.expr);
        let (syn::Pat::Ident(name), Some(state)) = (pattern, state) else {
            let help = "write `let linear = Sampler::default();`, or `Sampler { address: Address::Repeat, ..Sampler::default() }`";
            return refused(&init.expr, "a sampler that is not written out", help);
        };
        return Ok(Statement::Sampler(name.ident.clone(), state));
    }
    Ok(Statement::Other)
}

/// Reads a call of `assert_picture`.
fn read_call(file: u32, function: &syn::ItemFn, call: &syn::ExprCall) -> Refused<TestPicture> {
    let refused = |at: &dyn ToTokens, what: &str, help: &str| Err(unsupported(file, &at.to_token_stream(), what, help));
    let arguments: Vec<&syn::Expr> = call.args.iter().collect();
    let [name, size, closure, likeness] = arguments[..] else {
        let help = "write `assert_picture(\"golden.png\", uvec2(64, 36), |pixel| color(pixel), psnr(50.0))`";
        return refused(call, "`assert_picture` with such arguments", help);
    };
    let Some((golden, span)) = text_of(file, name) else {
        return refused(
            name,
            "a golden file whose name is not written out",
            "write `\"golden.png\"`",
        );
    };
    check_name(file, name, &golden)?;
    let pixels = read_size(file, function, size)?;
    check_closure(file, closure)?;
    let Some(likeness) = likeness_of(likeness) else {
        let help = "write `psnr(50.0)`, `absolute(0.01)` or `exactly()`";
        return refused(likeness, "such a tolerance of a picture", help);
    };
    Ok(TestPicture {
        variable: None,
        golden,
        span,
        size: pixels,
        likeness,
        images: Vec::new(),
        samplers: Vec::new(),
    })
}

/// Reads the size of a picture.
fn read_size(file: u32, function: &syn::ItemFn, size: &syn::Expr) -> Refused<[u32; 2]> {
    let Some(pixels) = size_of(function, size) else {
        let help = "write `uvec2(64, 36)`, or a variable with that: `let size = uvec2(64, 36);`";
        return Err(unsupported(file, size, "a size that is not written out", help));
    };
    if is_size(pixels) {
        return Ok(pixels);
    }
    let help = format!("sides are 1 to {MAX_SIDE} pixels, and a picture has at most {MAX_PIXELS}");
    Err(unsupported(file, size, "a picture of this size", &help))
}

fn check_closure(file: u32, closure: &syn::Expr) -> Refused<()> {
    match closure {
        syn::Expr::Closure(closure) if closure.inputs.len() == 1 => refuse_words(file, &closure.body),
        _ => {
            let help = "write `|pixel| color(pixel)`";
            Err(unsupported(file, closure, "a picture of no closure of the pixel", help))
        }
    }
}

/// Refuses pictures and samplers inside of other statements.
fn refuse_words(file: u32, part: &impl ToTokens) -> Refused<()> {
    let words = [
        (
            "read_picture",
            "let image: Texture<Vec4> = read_picture(\"chart.png\");",
        ),
        (
            "read_linear",
            "let normals: Texture<Vec3> = read_linear(\"normals.png\");",
        ),
        ("Sampler", "let linear = Sampler::default();"),
        (
            "assert_picture",
            "assert_picture(\"golden.png\", uvec2(64, 36), |pixel| color(pixel), psnr(50.0));",
        ),
    ];
    for (word, write) in words {
        if let Some(found) = find_word(part.to_token_stream(), word) {
            let help = format!("make it a statement of the test itself: `{write}`");
            return Err(unsupported(file, &found, &format!("`{word}` here"), &help));
        }
    }
    Ok(())
}

fn check_name(file: u32, at: &impl ToTokens, name: &str) -> Refused<()> {
    match name_error(name) {
        Some(reason) => {
            let help = format!("{reason}: name a PNG beside the file, or in a folder below it");
            Err(unsupported(
                file,
                &at.to_token_stream(),
                "a picture of this name",
                &help,
            ))
        }
        None => Ok(()),
    }
}

fn has_word(tokens: TokenStream, word: &str) -> bool {
    find_word(tokens, word).is_some()
}

fn find_word(tokens: TokenStream, word: &str) -> Option<Ident> {
    tokens.into_iter().find_map(|token| match token {
        TokenTree::Group(group) => find_word(group.stream(), word),
        TokenTree::Ident(found) if found == word => Some(found),
        _ => None,
    })
}

/// Removes `&` before the names of resources, which are references as parameters of a kernel.
fn without_borrows(tokens: TokenStream, names: &[String]) -> TokenStream {
    let mut out: Vec<TokenTree> = Vec::new();
    for token in tokens {
        match token {
            TokenTree::Group(group) => {
                let mut inner = Group::new(group.delimiter(), without_borrows(group.stream(), names));
                inner.set_span(group.span());
                out.push(TokenTree::Group(inner));
            }
            TokenTree::Ident(name) => {
                let is_borrow = |token: &TokenTree| matches!(token, TokenTree::Punct(mark) if mark.as_char() == '&');
                // Behind a value, `&` is an operator.
                let operand = out.len().checked_sub(2).map(|before| &out[before]);
                let is_value = matches!(
                    operand,
                    Some(TokenTree::Ident(_) | TokenTree::Literal(_) | TokenTree::Group(_))
                );
                if out.last().is_some_and(is_borrow) && !is_value && names.iter().any(|known| name == known) {
                    out.pop();
                }
                out.push(TokenTree::Ident(name));
            }
            other => out.push(other),
        }
    }
    out.into_iter().collect()
}
