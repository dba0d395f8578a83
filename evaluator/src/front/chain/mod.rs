//! Chains: functions of the kernel language whose calls of `draw` are passes.
//!
//! A chain is walked as it would run, on sizes, pictures, integers and options. Each call of `draw` that is reached becomes a
//! kernel, made of the closure and of what it mentions. The text of the file stays: its tokens keep their places, so that errors
//! in a pass name them. Other values of the chain are computed by each pass that mentions them.

mod capture;
mod control;
mod draw;
mod item;
mod lists;
mod numbers;
mod read;
mod rule;
mod signature;
mod state;
mod statements;
mod syntax;
mod value;
mod values;
mod walk;

use super::{Parsed, collect_items, inner, purposes, read_library, read_syntax, std, token_span};
use crate::diagnostic::{Code, Diagnostic, Errors, File, Span};
use ::std::sync::Arc;
use straightline_kernels::OptionValues;
use straightline_manifest::Format;
use straightline_manifest::chain::SizeRule;

pub use read::chain_of;
pub use signature::returns_pictures;

/// Most passes of a chain.
const MOST_PASSES: usize = 256;

/// Most statements and iterations that reading a chain takes.
const MOST_STEPS: usize = 100_000;

/// A filter of several passes.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// Name of its function.
    pub name: String,
    /// Place of the name.
    pub span: Span,
    /// Documentation of the function.
    pub docs: String,
    /// Textures, samplers and buffers that it takes.
    pub inputs: Vec<String>,
    /// Pictures in the order in which they are drawn; of each, the pass of the same index.
    pub pictures: Vec<Picture>,
    /// Passes in order.
    pub passes: Vec<Pass>,
    /// Indices of the pictures that the function returns.
    pub results: Vec<usize>,
}

/// A picture that a pass draws.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Name of its variable, with a number where several have it.
    pub name: String,
    /// Its size.
    pub size: SizeRule,
    /// Format that an attribute asks for.
    pub format: Option<Format>,
    /// Place of the call of `draw`.
    pub span: Span,
}

/// A pass: the kernel that a call of `draw` has become.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    /// Name of the kernel. Passes with the same text share it.
    pub entry: String,
    /// Parameters that are textures, samplers or buffers, with what each reads.
    pub reads: Vec<(String, Source)>,
    /// `true` if it depends on the chain's options.
    pub has_options: bool,
}

/// Origin of an input of a pass.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Source {
    /// An input of the chain, by name.
    Input(String),
    /// A picture, by index.
    Picture(usize),
}

/// A chain with the syntax of its files, of which each pass is lowered.
pub struct ReadChain {
    /// The chain.
    pub chain: Chain,
    files: Arc<Vec<File>>,
    /// Syntax of the files; functions that draw are empty.
    syntax: Vec<(u32, syn::File)>,
    /// Functions of the library that the files may call.
    library: syn::File,
    /// Kernels of the passes, each once.
    kernels: Vec<syn::ItemFn>,
}

/// Reads the chain `name` with these values of its options.
///
/// # Errors
///
/// A file that is not Rust, and every statement of the function that no chain has.
pub fn read_chain(files: &Arc<Vec<File>>, name: &str, options: &OptionValues) -> Result<ReadChain, Errors> {
    let mut syntax = read_hoisted(files)?;
    let walked = walk::walk_chain(&syntax, name, options).map_err(|found| Errors::new(found, files))?;
    // Every pass copies the syntax, and none needs these.
    for item in syntax.iter_mut().flat_map(|(_, file)| &mut file.items) {
        if let syn::Item::Fn(function) = item
            && signature::returns_pictures(&function.sig)
        {
            function.block.stmts.clear();
        }
    }
    Ok(ReadChain {
        chain: walked.chain,
        files: Arc::clone(files),
        syntax,
        library: read_library(files)?,
        kernels: walked.kernels,
    })
}

impl ReadChain {
    /// Lowers what a pass reaches, by the name of its kernel.
    ///
    /// # Errors
    ///
    /// As of [`parse`](super::parse).
    pub fn parse_pass(&self, entry: &str) -> Result<Parsed, Errors> {
        let kernel = self.kernels.iter().find(|kernel| kernel.sig.ident == entry);
        let syntax = (self.syntax.clone(), self.library.clone());
        lower_in_place(&self.files, syntax, &self.chain.name, kernel.cloned(), entry)
    }
}

/// Reads all files and lowers a kernel that has nothing but the options of a chain, so that they can be described.
///
/// # Errors
///
/// As of [`parse`](super::parse).
pub fn parse_options(files: &Arc<Vec<File>>, chain: &str) -> Result<Parsed, Errors> {
    let syntax = read_hoisted(files)?;
    let stub = read::find_function(&syntax, chain).map(|(_, function)| item::options_only(function));
    lower_in_place(files, (syntax, read_library(files)?), chain, stub, chain)
}

/// Reads the syntax of all files. Items inside of functions, which passes need too, stand outside.
fn read_hoisted(files: &Arc<Vec<File>>) -> Result<Vec<(u32, syn::File)>, Errors> {
    let mut syntax = read_syntax(files)?;
    for (_, parsed) in &mut syntax {
        inner::take_all(&mut parsed.items);
    }
    Ok(syntax)
}

/// Lowers `kernel`, which stands in the files in place of the chain, with the library.
fn lower_in_place(
    files: &Arc<Vec<File>>,
    (mut syntax, mut library): (Vec<(u32, syn::File)>, syn::File),
    chain: &str,
    kernel: Option<syn::ItemFn>,
    entry: &str,
) -> Result<Parsed, Errors> {
    let Some(kernel) = kernel else {
        let what = format!("the files have no chain `{chain}` with a pass `{entry}`");
        return Err(Errors::from_diagnostic(Diagnostic::new(Code::UnknownKernel, what)));
    };
    let mut kernel = Some(kernel);
    for (_, parsed) in &mut syntax {
        let own = parsed
            .items
            .iter_mut()
            .find(|item| matches!(item, syn::Item::Fn(function) if function.sig.ident == chain));
        if let (Some(own), true) = (own, kernel.is_some()) {
            *own = syn::Item::Fn(kernel.take().expect("just looked at"));
        }
        // Functions that draw are chains too, and no kernel calls one.
        parsed.items.retain(|item| match item {
            syn::Item::Fn(function) => function.sig.ident == entry || !signature::returns_pictures(&function.sig),
            _ => true,
        });
    }
    let mut items = collect_items(&mut syntax);
    items.add_file(std::FILE, &mut library);
    let lowered = items.lower_reached(entry);
    let mut parsed = lowered.map_err(|found| Errors::new(found, files))?;
    parsed.library.purposes = purposes::function_purposes(&parsed.library);
    Ok(parsed)
}

/// A refusal at a place.
fn refused(file: u32, at: &impl syn::spanned::Spanned, what: impl Into<String>, help: &str) -> Box<Diagnostic> {
    let error = Diagnostic::error_at(Code::ChainForm, token_span(file, at.span()), what)
        .label("in a chain")
        .help(help);
    Box::new(error)
}
