//! Contexts of OpenGL without a display.

use super::draw;
use super::program::Program;
use glow::HasContext;
use khronos_egl as egl;
use std::ffi::c_void;
use std::fmt;
use std::sync::OnceLock;

/// Help for systems without EGL, or without a driver for it.
const INSTALL: &str = "install Debian's libegl1 and libgl1-mesa-dri";

/// `EGL_PLATFORM_SURFACELESS_MESA`: a display that shows nothing.
const SURFACELESS: egl::Enum = 0x31DD;

/// A context of OpenGL that draws to textures only. It stays in the thread that made it.
pub struct Context {
    display: &'static Display,
    context: egl::Context,
    gl: glow::Context,
}

impl Context {
    /// A core context of OpenGL, of the highest version from 4.6 to 4.3 that the driver has.
    ///
    /// # Errors
    ///
    /// If there is no EGL or no such driver: what to install.
    pub fn desktop() -> Result<Self, String> {
        let profile = [egl::CONTEXT_OPENGL_PROFILE_MASK, egl::CONTEXT_OPENGL_CORE_PROFILE_BIT];
        Self::new(
            egl::OPENGL_API,
            "OpenGL 4.3",
            &[[4, 6], [4, 5], [4, 4], [4, 3]],
            &profile,
        )
    }

    /// A context of OpenGL ES, of the highest version from 3.2 to 3.0 that the driver has.
    ///
    /// # Errors
    ///
    /// If there is no EGL or no such driver: what to install.
    pub fn es() -> Result<Self, String> {
        Self::new(egl::OPENGL_ES_API, "OpenGL ES 3.0", &[[3, 2], [3, 1], [3, 0]], &[])
    }

    fn new(api: egl::Enum, least: &str, versions: &[[i32; 2]], more: &[i32]) -> Result<Self, String> {
        let display = Display::get()?;
        let failed = |doing: &str, error: egl::Error| format!("{doing}: {error}: {INSTALL}");
        let bound = display.egl.bind_api(api);
        bound.map_err(|e| failed(&format!("EGL has no {least}"), e))?;
        let renderable = match api {
            egl::OPENGL_API => egl::OPENGL_BIT,
            _ => egl::OPENGL_ES3_BIT,
        };
        // Nothing is drawn to a surface, but no driver offers configurations for none.
        let wanted = [
            egl::SURFACE_TYPE,
            egl::PBUFFER_BIT,
            egl::RENDERABLE_TYPE,
            renderable,
            egl::NONE,
        ];
        let config = display.egl.choose_first_config(display.handle, &wanted);
        let config = config.map_err(|e| failed(&format!("EGL has no {least}"), e))?;
        let config = config.ok_or_else(|| format!("EGL has no {least}: {INSTALL}"))?;
        let mut refused = String::new();
        for [major, minor] in versions {
            let mut attributes = vec![egl::CONTEXT_MAJOR_VERSION, *major, egl::CONTEXT_MINOR_VERSION, *minor];
            attributes.extend(more);
            attributes.push(egl::NONE);
            match display.egl.create_context(display.handle, config, None, &attributes) {
                Ok(context) => return Self::of(display, context),
                Err(error) => refused = failed(&format!("the driver has no {least}"), error),
            }
        }
        Err(refused)
    }

    fn of(display: &'static Display, context: egl::Context) -> Result<Self, String> {
        let current = display.egl.make_current(display.handle, None, None, Some(context));
        if let Err(error) = current {
            // The context is not used any more, and a failure to destroy it can only be ignored.
            let _ = display.egl.destroy_context(display.handle, context);
            return Err(format!("a context without a surface: {error}: {INSTALL}"));
        }
        let find = |name: &str| {
            let function = display.egl.get_proc_address(name);
            function.map_or(std::ptr::null(), |function| function as *const c_void)
        };
        // SAFETY: the context is current, and EGL finds the functions that go with it.
        let gl = unsafe { glow::Context::from_loader_function(find) };
        Ok(Context { display, context, gl })
    }

    /// The driver and its version, such as `llvmpipe (...), 4.5 (Core Profile) Mesa ...`.
    ///
    /// # Errors
    ///
    /// If the context cannot be used.
    pub fn driver(&self) -> Result<String, String> {
        self.make_current()?;
        // SAFETY: the context is current, and both names are OpenGL's.
        let [renderer, version] =
            [glow::RENDERER, glow::VERSION].map(|name| unsafe { self.gl.get_parameter_string(name) });
        Ok(format!("{renderer}, {version}"))
    }

    /// The picture that a program computes, row by row from `y = 0`, which is the row of the least `gl_FragCoord.y`.
    ///
    /// # Errors
    ///
    /// The compiler's or linker's log with the text, its lines numbered; a name that the text does not have; an input that does
    /// not fit; or what OpenGL refused.
    pub fn run(&self, program: &Program<'_>) -> Result<Vec<[f32; 4]>, String> {
        self.make_current()?;
        draw::run(&self.gl, program)
    }

    fn make_current(&self) -> Result<(), String> {
        let Display { egl, handle } = self.display;
        let current = egl.make_current(*handle, None, None, Some(self.context));
        current.map_err(|error| format!("the context cannot be used: {error}"))
    }
}

impl Drop for Context {
    fn drop(&mut self) {
        let Display { egl, handle } = self.display;
        if egl.get_current_context() == Some(self.context) {
            let _ = egl.make_current(*handle, None, None, None);
        }
        let _ = egl.destroy_context(*handle, self.context);
    }
}

impl fmt::Debug for Context {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Context")
            .field("context", &self.context)
            .finish_non_exhaustive()
    }
}

/// EGL with its display that shows nothing. A process has one, which stays: closing it would close it for all.
struct Display {
    egl: egl::DynamicInstance<egl::EGL1_5>,
    handle: egl::Display,
}

// SAFETY: EGL may be called from any thread, and the handle of a display means the same in all of them.
unsafe impl Send for Display {}
// SAFETY: as above.
unsafe impl Sync for Display {}

impl Display {
    fn get() -> Result<&'static Self, String> {
        static DISPLAY: OnceLock<Result<Display, String>> = OnceLock::new();
        DISPLAY.get_or_init(Self::open).as_ref().map_err(Clone::clone)
    }

    fn open() -> Result<Self, String> {
        // SAFETY: a library of this name is EGL.
        let egl = unsafe { egl::DynamicInstance::<egl::EGL1_5>::load_required() };
        let egl = egl.map_err(|error| format!("cannot load EGL 1.5 ({error:?}): {INSTALL}"))?;
        // SAFETY: this platform takes no native display but the default one.
        let handle = unsafe { egl.get_platform_display(SURFACELESS, egl::DEFAULT_DISPLAY, &[egl::ATTRIB_NONE]) };
        let handle = handle.map_err(|error| format!("EGL has no display without a screen ({error}): {INSTALL}"))?;
        let opened = egl.initialize(handle);
        opened.map_err(|error| format!("EGL finds no driver ({error}): {INSTALL}"))?;
        Ok(Display { egl, handle })
    }
}
