//! Passes that are made on another thread.

use crate::Error;
use wgpu::WasmNotSend;

/// A pass, chain or draw that is being made on another thread, so that a frame does not wait for the driver.
///
/// In a browser there are no threads: it is made at once, and the first [`poll`](Self::poll) returns it.
///
/// Dropping it does not stop the thread; its result is dropped.
///
/// ```no_run
/// use straightline_runtime::{Error, Pass, PassOptions, Pending, Shader, wgpu};
///
/// struct Renderer {
///     making: Pending<Pass>,
///     pass: Option<Pass>,
/// }
///
/// impl Renderer {
///     // Usually `shaders::sraa::SHADER`.
///     fn new(device: &wgpu::Device, shader: &'static Shader<'static>) -> Self {
///         let device = device.clone();
///         let making = Pending::start(move || Pass::from_shader(&device, shader, &PassOptions::default()));
///         Renderer { making, pass: None }
///     }
///
///     fn frame(&mut self) -> Result<(), Error> {
///         if let Some(made) = self.making.poll() {
///             self.pass = Some(made?);
///         }
///         // Draws without the effect until there is a pass.
///         Ok(())
///     }
/// }
/// ```
#[derive(Debug)]
pub struct Pending<T>(State<T>);

#[derive(Debug)]
enum State<T> {
    #[cfg(not(target_arch = "wasm32"))]
    Making(std::thread::JoinHandle<Result<T, Error>>),
    Made(Result<T, Error>),
    Taken,
}

impl<T: WasmNotSend + 'static> Pending<T> {
    /// Starts `make` on a thread of its own; the result is [`Error::Thread`] if none can be started. Any number may be
    /// under way: wgpu keeps the errors of each thread apart.
    pub fn start(make: impl FnOnce() -> Result<T, Error> + WasmNotSend + 'static) -> Self {
        Pending(start(make))
    }

    /// Returns the result once it is there, the first time that it is asked for; `None` before and afterwards. Does not
    /// wait.
    ///
    /// # Panics
    ///
    /// If `make` has panicked.
    pub fn poll(&mut self) -> Option<Result<T, Error>> {
        #[cfg(not(target_arch = "wasm32"))]
        if matches!(&self.0, State::Making(thread) if !thread.is_finished()) {
            return None;
        }
        std::mem::replace(&mut self.0, State::Taken).take()
    }

    /// Waits for the result; `None` if it was taken.
    ///
    /// # Panics
    ///
    /// If `make` has panicked.
    pub fn wait(self) -> Option<Result<T, Error>> {
        self.0.take()
    }
}

impl<T> State<T> {
    /// The result, waiting for it.
    fn take(self) -> Option<Result<T, Error>> {
        match self {
            #[cfg(not(target_arch = "wasm32"))]
            State::Making(thread) => Some(thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))),
            State::Made(result) => Some(result),
            State::Taken => None,
        }
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn start<T: Send + 'static>(make: impl FnOnce() -> Result<T, Error> + Send + 'static) -> State<T> {
    let thread = std::thread::Builder::new().name("straightline".to_owned());
    thread
        .spawn(make)
        .map_or_else(|error| State::Made(Err(Error::Thread(error))), State::Making)
}

#[cfg(target_arch = "wasm32")]
fn start<T>(make: impl FnOnce() -> Result<T, Error>) -> State<T> {
    State::Made(make())
}
