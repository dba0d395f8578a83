//! The items that a shader's module has for its candidates, other shaders that compute the same.

use super::pass::{Given, Targets};
use super::{Module, doc_line, rust_identifier};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// Input of the module of a shader with candidates.
pub struct CandidatesModule<'a> {
    /// The shader of the kernel's own settings.
    pub own: Module<'a>,
    /// Other shaders.
    pub others: Vec<Module<'a>>,
    /// Names of the candidates with the position of their shader, of which the kernel's own is 0.
    pub candidates: &'a [(String, usize)],
}

/// Returns the modules of the other shaders, the constant `CANDIDATES` and `Pass::choose`.
pub fn quote_candidates(
    set: &CandidatesModule<'_>,
    others: &[TokenStream],
    given: &Given,
    targets: &Targets,
) -> TokenStream {
    // A shader is timed once, under its first name.
    let shaders = 0..=set.others.len();
    let first = shaders.map(|at| set.candidates.iter().find(|(_, of)| *of == at));
    let candidates: Vec<TokenStream> = first
        .flatten()
        .map(|(name, at)| {
            let module = at.checked_sub(1).map(|k| rust_identifier(set.others[k].name));
            let module = module.map(|module| quote! { #module:: });
            quote! { straightline_runtime::Candidate { name: #name, shader: &#module SHADER } }
        })
        .collect();
    let count = Literal::usize_unsuffixed(candidates.len());
    let twins = set.candidates.iter().enumerate().filter_map(|(k, (name, at))| {
        let (twin, _) = set.candidates[..k].iter().find(|(_, other)| other == at)?;
        Some(doc_line(&format!("`{name}` has the same text as `{twin}`.")))
    });
    let choose = given.quote_choose(targets);
    quote! {
        #(#others)*

        /// Candidates of the shader, which compute the same.
        #(#[doc = #twins])*
        pub static CANDIDATES: [straightline_runtime::Candidate<'static>; #count] = [#(#candidates),*];

        #choose
    }
}
