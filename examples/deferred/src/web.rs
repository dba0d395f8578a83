//! Frames on the canvas of a page, and as bytes for a script.

use crate::antialiasing::Choice;
use crate::gpu::Gpu;
use crate::options::Options;
use crate::renderer::Renderer;
use crate::{Failure, picture};
use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use straightline_sraa::wgpu;
use wasm_bindgen::prelude::*;
use web_sys::{Element, HtmlCanvasElement, KeyboardEvent, Window};
use web_time::Instant;
use wgpu::CurrentSurfaceTexture;

/// Upper limit on frames in flight. A browser requests more than it can draw.
const AHEAD: u32 = 2;

/// Draws on the page's `<canvas>` until the page is closed. Writes frame times, or an error, to `#state`.
pub fn start() {
    std::panic::set_hook(Box::new(|panic| web_sys::console::error_1(&panic.to_string().into())));
    wasm_bindgen_futures::spawn_local(async {
        if let Err(failure) = run().await {
            say(&failure.to_string());
        }
    });
}

/// Returns the frame for an address: four bytes a pixel, sRGB, rows from the top. Scripts cannot read a canvas reliably, so the
/// same renderer draws to a texture instead.
#[wasm_bindgen]
pub async fn picture(address: &str) -> Result<Vec<u8>, JsError> {
    let drawn = async {
        let Options { size, time, antialiasing, .. } = Options::of_address(address)?;
        let gpu = Gpu::headless(false).await?;
        let mut renderer = Renderer::new(&gpu.device, &gpu.queue, size, picture::FORMAT)?;
        picture::draw(&gpu, &mut renderer, size, time.unwrap_or(2.0), antialiasing).await
    };
    drawn.await.map_err(|failure: Failure| JsError::new(&failure.to_string()))
}

struct Screen {
    gpu: Gpu,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    renderer: Renderer,
    choice: Choice,
    /// Fixed time, in seconds.
    time: Option<f32>,
    /// Frames that are submitted and not completed.
    under_way: Arc<AtomicU32>,
    started: Instant,
    /// Start of the count, and number of frames since.
    counted: (Instant, u32),
}

impl Screen {
    async fn new(canvas: HtmlCanvasElement, options: &Options) -> Result<Self, Failure> {
        let [width, height] = options.size;
        canvas.set_width(width);
        canvas.set_height(height);
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let surface = instance.create_surface(wgpu::SurfaceTarget::Canvas(canvas))?;
        let gpu = Gpu::new(&instance, Some(&surface), options.timestamps).await?;
        let config = surface.get_default_config(&gpu.adapter, width, height);
        let mut config = config.ok_or("the adapter cannot draw to this canvas")?;
        // The renderer outputs linear colours; the format converts them.
        let format = config.format.add_srgb_suffix();
        config.view_formats.push(format);
        surface.configure(&gpu.device, &config);
        let renderer = Renderer::new(&gpu.device, &gpu.queue, options.size, format)?;
        let now = Instant::now();
        Ok(Screen {
            gpu,
            surface,
            config,
            renderer,
            choice: Choice::new(options.antialiasing),
            time: options.time,
            under_way: Arc::default(),
            started: now,
            counted: (now, 0),
        })
    }

    fn draw(&mut self) -> Result<(), Failure> {
        if self.under_way.load(Ordering::Relaxed) >= AHEAD {
            return Ok(());
        }
        let frame = match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(frame) | CurrentSurfaceTexture::Suboptimal(frame) => frame,
            // There is nothing to draw to now; the next frame may succeed.
            _ => return Ok(()),
        };
        let view = frame.texture.create_view(&wgpu::TextureViewDescriptor {
            format: Some(self.config.format.add_srgb_suffix()),
            ..Default::default()
        });
        let time = self.time.unwrap_or(self.started.elapsed().as_secs_f32());
        self.renderer.draw(time, self.choice.now, &view)?;
        self.under_way.fetch_add(1, Ordering::Relaxed);
        let under_way = Arc::clone(&self.under_way);
        self.gpu.queue.on_submitted_work_done(move || {
            under_way.fetch_sub(1, Ordering::Relaxed);
        });
        self.gpu.queue.present(frame);
        self.count()
    }

    /// Forgets the frames of the choice before.
    fn restart_count(&mut self) {
        self.renderer.clock.clear();
        self.counted = (Instant::now(), 0);
    }

    /// Counts a frame, and shows the time per frame once a second.
    fn count(&mut self) -> Result<(), Failure> {
        let (since, frames) = &mut self.counted;
        *frames += 1;
        let (elapsed, frames) = (since.elapsed(), *frames);
        if elapsed.as_secs() >= 1
            && let Some(costs) = self.renderer.clock.take()?
        {
            self.counted = (Instant::now(), 0);
            let each = elapsed.as_secs_f64() * 1e3 / f64::from(frames);
            say(&format!("{}: {each:.1} ms a frame, {}; {costs}", self.choice.now, self.gpu.clock()));
        }
        Ok(())
    }
}

async fn run() -> Result<(), Failure> {
    let options = Options::of_address(&window().location().search().unwrap_or_default())?;
    if options.out.is_some() || options.table {
        return Err("a page has neither `out` nor `table`".into());
    }
    let canvas = element("canvas").and_then(|element| element.dyn_into().ok());
    let screen = Screen::new(canvas.ok_or("the page has no <canvas>")?, &options).await?;
    say(&screen.choice.now.to_string());
    let screen = Rc::new(RefCell::new(screen));
    choose_by_keys(Rc::clone(&screen));
    draw_every_frame(screen);
    Ok(())
}

fn choose_by_keys(screen: Rc<RefCell<Screen>>) {
    let pressed = Closure::<dyn FnMut(_)>::new(move |event: KeyboardEvent| {
        let with_others = event.ctrl_key() || event.alt_key() || event.meta_key();
        let key = if event.key() == " " { "Space".to_owned() } else { event.key() };
        let mut screen = screen.borrow_mut();
        if !event.repeat() && !with_others && screen.choice.press(&key) {
            event.prevent_default();
            screen.restart_count();
            say(&screen.choice.now.to_string());
        }
    });
    window().set_onkeydown(Some(pressed.as_ref().unchecked_ref()));
    // The closure must live as long as the page.
    pressed.forget();
}

/// Requests each next frame from the browser, until one fails.
fn draw_every_frame(screen: Rc<RefCell<Screen>>) {
    let next = Rc::new(RefCell::new(None::<Closure<dyn FnMut()>>));
    let again = Rc::clone(&next);
    *next.borrow_mut() = Some(Closure::new(move || match screen.borrow_mut().draw() {
        Ok(()) => request(&again),
        Err(failure) => say(&failure.to_string()),
    }));
    request(&next);
}

fn request(frame: &RefCell<Option<Closure<dyn FnMut()>>>) {
    if let Some(frame) = &*frame.borrow()
        && window().request_animation_frame(frame.as_ref().unchecked_ref()).is_err()
    {
        say("the browser gives no more frames");
    }
}

fn window() -> Window {
    web_sys::window().expect("only a page calls this, and a page has a window")
}

fn element(selector: &str) -> Option<Element> {
    window().document()?.query_selector(selector).ok()?
}

fn say(text: &str) {
    if let Some(element) = element("#state") {
        element.set_text_content(Some(text));
    }
}
