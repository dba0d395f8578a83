//! Panics of properties: they are caught, kept quiet while a case is minimised, and keep their place.

use std::cell::{Cell, RefCell};
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::sync::Once;

/// Outcome of a property for one case.
pub enum Outcome {
    /// The property returned.
    Held,
    /// `assume` passed over the case.
    PassedOver,
    /// The property panicked, with this place and message.
    Failed(String),
}

/// Payload of the panic of `assume`.
struct PassedOver;

thread_local! {
    /// `true` while a property runs.
    static RUNS: Cell<bool> = const { Cell::new(false) };
    static MESSAGE: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Leaves the property.
pub fn pass_over() -> ! {
    panic::resume_unwind(Box::new(PassedOver))
}

/// Runs a property on one case.
pub fn run_caught(property: impl FnOnce()) -> Outcome {
    static INSTALL: Once = Once::new();
    INSTALL.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| match RUNS.get() {
            true => MESSAGE.set(describe_panic(info)),
            false => before(info),
        }));
    });
    RUNS.set(true);
    let outcome = panic::catch_unwind(AssertUnwindSafe(property));
    RUNS.set(false);
    match outcome {
        Ok(()) => Outcome::Held,
        Err(payload) if payload.is::<PassedOver>() => Outcome::PassedOver,
        Err(_) => Outcome::Failed(MESSAGE.take()),
    }
}

fn describe_panic(info: &PanicHookInfo<'_>) -> String {
    let payload = info.payload();
    let text = payload.downcast_ref::<&str>().copied();
    let message = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    let message = message.unwrap_or("a panic without a message");
    match info.location() {
        Some(at) => format!("{}:{}: {message}", at.file(), at.line()),
        None => message.to_owned(),
    }
}
