//! DXC, Microsoft's compiler of HLSL, called in this process through its COM interface.
#![expect(
    unsafe_code,
    reason = "DXC's functions are foreign; each object is made, used and released in one function"
)]

use libloading::Library;
use std::ffi::c_void;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// Compiles HLSL by DXC. `arguments` are those of its command line: `-T cs_6_0 -E main -spirv`.
///
/// # Errors
///
/// The library is not there, or DXC refuses the text or warns of something in it: what it says.
///
/// # Example
///
/// ```no_run
/// let text = "[numthreads(1, 1, 1)] void main() {}";
/// let dxil = straightline_foreign::dxc::compile(text, &["-T", "cs_6_0", "-E", "main"])?;
/// # Ok::<(), String>(())
/// ```
pub fn compile(text: &str, arguments: &[&str]) -> Result<Vec<u8>, String> {
    static DXC: LazyLock<Result<Dxc, String>> = LazyLock::new(Dxc::load);
    DXC.as_ref().map_err(String::clone)?.compile(text, arguments)
}

/// Path of the library as `tools/dxc` installs it.
fn installed() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    root.join("target/dxc/libdxcompiler.so")
}

/// The loaded library.
struct Dxc {
    create: CreateInstance,
    // Unloads the library when it goes.
    _library: Library,
}

/// Ends the process without the destructors of its libraries. DXC's destructor takes an LLVM lock at exit, which has
/// deadlocked when a driver was loaded too. Rust has flushed its output by then.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
fn skip_destructors() {
    unsafe extern "C" {
        fn on_exit(function: extern "C" fn(i32, *mut c_void), argument: *mut c_void) -> i32;
        fn _exit(status: i32) -> !;
    }
    extern "C" fn end(status: i32, _: *mut c_void) {
        // SAFETY: ends the process, with the status that it would have ended with.
        unsafe { _exit(status) }
    }
    // SAFETY: the function lives as long as the process, and ignores its arguments.
    unsafe { on_exit(end, std::ptr::null_mut()) };
}

/// The deadlock was not observed on other systems.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
fn skip_destructors() {}

type CreateInstance = unsafe extern "C" fn(*const Guid, *const Guid, *mut Object) -> i32;

/// A COM object: a pointer to its table of functions.
type Object = *mut *const *const c_void;

#[repr(C)]
struct Guid(u32, u16, u16, [u8; 8]);

/// `CLSID_DxcCompiler`.
const COMPILER_CLASS: Guid = Guid(
    0x73e2_2d93,
    0xe6ce,
    0x47f3,
    [0xb5, 0xbf, 0xf0, 0x66, 0x4f, 0x39, 0xc1, 0xb0],
);
/// `IDxcCompiler3`.
const COMPILER: Guid = Guid(
    0x228b_4687,
    0x5a6a,
    0x4730,
    [0x90, 0x0c, 0x97, 0x02, 0xb2, 0x20, 0x3f, 0x54],
);
/// `IDxcResult`.
const RESULT: Guid = Guid(
    0x5834_6cda,
    0xdde7,
    0x4497,
    [0x94, 0x61, 0x6f, 0x87, 0xaf, 0x5e, 0x06, 0x59],
);

/// `DxcBuffer`.
#[repr(C)]
struct Buffer {
    bytes: *const u8,
    length: usize,
    /// Code page of the text.
    encoding: u32,
}

/// A warning independent of the text: outside of Windows compiled DXIL is never signed.
const UNSIGNED: &str = "DXIL will not be signed";

/// Code page of UTF-8.
const UTF_8: u32 = 65001;

// Functions by their index in the table. Objects outside of Windows have two destructors after `Release`.
/// `IUnknown::Release`.
const RELEASE: usize = 2;
/// `IDxcCompiler3::Compile`.
const COMPILE: usize = 5;
/// `IDxcOperationResult::GetStatus`.
const STATUS: usize = 5;
/// `IDxcOperationResult::GetResult`.
const OUTPUT: usize = 6;
/// `IDxcOperationResult::GetErrorBuffer`.
const ERRORS: usize = 7;
/// `IDxcBlob::GetBufferPointer`.
const POINTER: usize = 5;
/// `IDxcBlob::GetBufferSize`.
const SIZE: usize = 6;

type Compile =
    unsafe extern "C" fn(Object, *const Buffer, *const *const u32, u32, Object, *const Guid, *mut Object) -> i32;
type Status = unsafe extern "C" fn(Object, *mut i32) -> i32;
type Get = unsafe extern "C" fn(Object, *mut Object) -> i32;
type Pointer = unsafe extern "C" fn(Object) -> *const u8;
type Size = unsafe extern "C" fn(Object) -> usize;
type Release = unsafe extern "C" fn(Object) -> u32;

impl Dxc {
    fn load() -> Result<Dxc, String> {
        let path = installed();
        if !path.exists() {
            return Err(format!(
                "no DXC, the compiler of HLSL, at target/dxc/{}: run tools/dxc, which fetches it",
                path.file_name().unwrap_or_default().display()
            ));
        }
        let failed = |e| format!("{}: {e}", path.display());
        // SAFETY: a library of compilers that does nothing but initialise itself when it is loaded; the type of its one
        // function is that of `dxcapi.h`.
        unsafe {
            let library = Library::new(&path).map_err(failed)?;
            let create = *library.get::<CreateInstance>(b"DxcCreateInstance\0").map_err(failed)?;
            skip_destructors();
            Ok(Dxc {
                create,
                _library: library,
            })
        }
    }

    fn compile(&self, text: &str, arguments: &[&str]) -> Result<Vec<u8>, String> {
        // DXC's strings have characters of four bytes and end with a zero.
        let wide = |argument: &&str| argument.chars().chain(['\0']).map(u32::from).collect::<Vec<_>>();
        let wide: Vec<Vec<u32>> = arguments.iter().map(wide).collect();
        let pointers: Vec<*const u32> = wide.iter().map(|argument| argument.as_ptr()).collect();
        let source = Buffer {
            bytes: text.as_ptr(),
            length: text.len(),
            encoding: UTF_8,
        };
        let none: Object = std::ptr::null_mut();
        // SAFETY: the tables are those of `dxcapi.h`, all that is pointed at outlives the calls, and an object is used only
        // where the call that gives it succeeded.
        unsafe {
            let mut compiler = none;
            let code = (self.create)(&COMPILER_CLASS, &COMPILER, &mut compiler);
            let compiler = Owned::new(compiler, code, "DxcCreateInstance")?;
            let compile: Compile = compiler.function(COMPILE);
            let mut result = none;
            let count = pointers.len() as u32;
            let code = compile(
                compiler.0,
                &source,
                pointers.as_ptr(),
                count,
                none,
                &RESULT,
                &mut result,
            );
            let result = Owned::new(result, code, "IDxcCompiler3::Compile")?;
            let mut status = 0;
            let code = result.function::<Status>(STATUS)(result.0, &mut status);
            let said = result.blob(ERRORS).unwrap_or_default();
            let said = String::from_utf8_lossy(&said);
            let warns = said
                .lines()
                .any(|line| line.contains("warning:") && !line.contains(UNSIGNED));
            match code < 0 || status < 0 || warns {
                true => Err(said.into_owned()),
                false => result.blob(OUTPUT),
            }
        }
    }
}

/// An object that is released when it goes.
struct Owned(Object);

impl Owned {
    /// Wraps the object that a call returned. Fails if its code is an error.
    fn new(object: Object, code: i32, call: &str) -> Result<Owned, String> {
        match code < 0 || object.is_null() {
            true => Err(format!("DXC: {call} failed with {code:#x}")),
            false => Ok(Owned(object)),
        }
    }

    /// Returns a function of the object's table.
    ///
    /// # Safety
    ///
    /// `F` is the type of the function at that place.
    unsafe fn function<F: Copy>(&self, place: usize) -> F {
        assert_eq!(size_of::<F>(), size_of::<*const c_void>(), "a pointer to a function");
        // SAFETY: the table has the place, by the caller's promise.
        unsafe { std::mem::transmute_copy(&*(*self.0).add(place)) }
    }

    /// Returns the bytes that a function of the table returns as a blob; empty without a blob.
    ///
    /// # Safety
    ///
    /// There is a function of type [`Get`] at that place.
    unsafe fn blob(&self, place: usize) -> Result<Vec<u8>, String> {
        let mut blob: Object = std::ptr::null_mut();
        // SAFETY: the function is there, by the caller's promise, and the bytes are copied before the blob is released.
        unsafe {
            let code = self.function::<Get>(place)(self.0, &mut blob);
            if code >= 0 && blob.is_null() {
                return Ok(Vec::new());
            }
            let blob = Owned::new(blob, code, "a blob")?;
            let bytes = blob.function::<Pointer>(POINTER)(blob.0);
            let length = blob.function::<Size>(SIZE)(blob.0);
            match bytes.is_null() {
                true => Ok(Vec::new()),
                false => Ok(std::slice::from_raw_parts(bytes, length).to_vec()),
            }
        }
    }
}

impl Drop for Owned {
    fn drop(&mut self) {
        // SAFETY: this is the only reference.
        unsafe { self.function::<Release>(RELEASE)(self.0) };
    }
}
