//! `completions` and `man`: descriptions of the command line for shells and `man`.

use crate::args::{Arguments, CompletionsArgs, ManArgs};
use crate::failure::Failure;
use clap::{Command, CommandFactory};
use clap_mangen::Man;
use std::collections::BTreeMap;
use straightline_codegen::files;

/// Prints the completions for a shell.
pub fn print_completions(args: &CompletionsArgs) -> Result<(), Failure> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut Arguments::command(), "straightline", &mut text);
    out!("{}", String::from_utf8_lossy(&text));
    Ok(())
}

/// Writes a manual page for each command and prints the paths.
pub fn write_manual(args: &ManArgs) -> Result<(), Failure> {
    let mut command = Arguments::command();
    command.build();
    let mut pages = BTreeMap::new();
    add(&command, &mut pages)?;
    for path in files::write_all(&args.out, &pages).map_err(Failure::from_error)? {
        outln!("{}", path.display());
    }
    Ok(())
}

/// Adds the pages of a command and of its subcommands.
fn add(command: &Command, pages: &mut BTreeMap<String, Vec<u8>>) -> Result<(), Failure> {
    let page = Man::new(command.clone());
    let mut text = Vec::new();
    page.render(&mut text).map_err(Failure::from_error)?;
    pages.insert(page.get_filename(), text);
    let shown = command.get_subcommands().filter(|below| !below.is_hide_set());
    shown
        .filter(|below| below.get_name() != "help")
        .try_for_each(|below| add(below, pages))
}
