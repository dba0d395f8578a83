//! How the page's worker calls: it asks for room, writes its message there, and calls. No pointer is followed here: the host
//! reads and writes the module's memory itself.

// The exported names are what makes this "unsafe": two functions of one name would be a mistake of the linker's.
#![allow(unsafe_code)]

use crate::message::answer;
use std::cell::RefCell;

thread_local! {
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Room for a message of so many bytes. Returns its address.
#[unsafe(no_mangle)]
extern "C" fn request(length: usize) -> usize {
    REQUEST.with_borrow_mut(|request| {
        request.clear();
        request.resize(length, 0);
        request.as_mut_ptr() as usize
    })
}

/// Answers the message that was written. Returns the length of the answer.
#[unsafe(no_mangle)]
extern "C" fn call() -> usize {
    let request = REQUEST.take();
    let given = answer(&request);
    let length = given.len();
    ANSWER.set(given);
    length
}

/// Address of the last answer.
#[unsafe(no_mangle)]
extern "C" fn answered() -> usize {
    ANSWER.with_borrow(|answer| answer.as_ptr() as usize)
}
