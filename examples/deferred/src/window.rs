//! Frames in a window.

use crate::antialiasing::{Antialiasing, Choice};
use crate::gpu::Gpu;
use crate::options::Options;
use crate::renderer::Renderer;
use crate::{Failure, Size};
use std::sync::Arc;
use std::time::Instant;
use straightline_sraa::wgpu;
use wgpu::CurrentSurfaceTexture;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::{ElementState, KeyEvent, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::keyboard::{Key, NamedKey};
use winit::window::{Window, WindowId};

/// Opens a window of `size` and draws until it is closed.
pub fn run(options: &Options) -> Result<(), Failure> {
    let events =
        EventLoop::new().map_err(|error| format!("{error}\nWithout a screen, draw a picture: --out FILE.png"))?;
    let mut application = Application {
        size: options.size,
        time: options.time,
        timestamps: options.timestamps,
        choice: Choice::new(options.antialiasing),
        started: Instant::now(),
        screen: None,
        counted: (Instant::now(), 0),
        failure: None,
    };
    events.run_app(&mut application)?;
    application.failure.map_or(Ok(()), Err)
}

struct Application {
    size: Size,
    /// Fixed time, in seconds.
    time: Option<f32>,
    timestamps: bool,
    choice: Choice,
    started: Instant,
    /// Set as soon as a window can be created.
    screen: Option<Screen>,
    /// Start of the count, and number of frames since.
    counted: (Instant, u32),
    failure: Option<Failure>,
}

struct Screen {
    window: Arc<Window>,
    gpu: Gpu,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    renderer: Renderer,
}

impl Screen {
    fn new(events: &ActiveEventLoop, [width, height]: Size, timestamps: bool) -> Result<Self, Failure> {
        let attributes = Window::default_attributes().with_inner_size(PhysicalSize::new(width, height));
        let window = Arc::new(events.create_window(attributes)?);
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let surface = instance.create_surface(window.clone())?;
        let gpu = pollster::block_on(Gpu::new(&instance, Some(&surface), timestamps))?;
        let size = window.inner_size();
        let mut config = surface
            .get_default_config(&gpu.adapter, size.width.max(1), size.height.max(1))
            .ok_or("the adapter cannot draw to this window")?;
        // The renderer outputs linear colours; the format converts them.
        let format = config.format.add_srgb_suffix();
        if format != config.format {
            config.view_formats.push(format);
        }
        surface.configure(&gpu.device, &config);
        let renderer = Renderer::new(&gpu.device, &gpu.queue, [config.width, config.height], format)?;
        Ok(Screen { window, gpu, surface, config, renderer })
    }

    fn resize(&mut self, size: PhysicalSize<u32>) {
        // A minimised window has no size.
        if size.width > 0 && size.height > 0 {
            (self.config.width, self.config.height) = (size.width, size.height);
            self.surface.configure(&self.gpu.device, &self.config);
        }
    }

    fn draw(&mut self, time: f32, antialiasing: Antialiasing) -> Result<(), Failure> {
        let frame = match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(frame) | CurrentSurfaceTexture::Suboptimal(frame) => frame,
            CurrentSurfaceTexture::Outdated | CurrentSurfaceTexture::Lost => {
                self.surface.configure(&self.gpu.device, &self.config);
                return Ok(());
            }
            // There is nothing to draw to now; the next frame may succeed.
            _ => return Ok(()),
        };
        let view = frame.texture.create_view(&wgpu::TextureViewDescriptor {
            format: Some(self.config.format.add_srgb_suffix()),
            ..Default::default()
        });
        self.renderer.draw(time, antialiasing, &view)?;
        self.window.pre_present_notify();
        self.gpu.queue.present(frame);
        Ok(())
    }
}

impl ApplicationHandler for Application {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.screen.is_none() {
            match Screen::new(events, self.size, self.timestamps) {
                Ok(screen) => self.screen = Some(screen),
                Err(failure) => self.fail(events, failure),
            }
        }
        self.show_state("");
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(screen) = &mut self.screen else { return };
        match event {
            WindowEvent::CloseRequested => events.exit(),
            WindowEvent::Resized(size) => screen.resize(size),
            WindowEvent::KeyboardInput {
                event: KeyEvent { logical_key, state: ElementState::Pressed, repeat: false, .. },
                ..
            } => {
                let key = match &logical_key {
                    Key::Named(NamedKey::Escape) => return events.exit(),
                    Key::Named(NamedKey::Space) => "Space",
                    Key::Character(key) => key,
                    _ => return,
                };
                if self.choice.press(key) {
                    // Frames of the choice before do not count.
                    screen.renderer.clock.clear();
                    self.counted = (Instant::now(), 0);
                    self.show_state("");
                }
            }
            WindowEvent::RedrawRequested => {
                let time = self.time.unwrap_or(self.started.elapsed().as_secs_f32());
                if let Err(failure) = screen.draw(time, self.choice.now).and_then(|()| self.count()) {
                    self.fail(events, failure);
                }
            }
            _ => {}
        }
    }

    fn about_to_wait(&mut self, _: &ActiveEventLoop) {
        if let Some(screen) = &self.screen {
            screen.window.request_redraw();
        }
    }
}

impl Application {
    fn show_state(&self, frames: &str) {
        if let Some(screen) = &self.screen {
            screen.window.set_title(&format!("{}{frames}", self.choice.now));
        }
    }

    /// Counts a frame, and shows the time per frame once a second.
    fn count(&mut self) -> Result<(), Failure> {
        let (since, frames) = &mut self.counted;
        *frames += 1;
        let (elapsed, frames) = (since.elapsed(), *frames);
        if elapsed.as_secs() >= 1
            && let Some(screen) = &mut self.screen
            && let Some(costs) = screen.renderer.clock.take()?
        {
            let (each, how) = (elapsed.as_secs_f64() * 1e3 / f64::from(frames), screen.gpu.clock());
            self.counted = (Instant::now(), 0);
            self.show_state(&format!(": {each:.1} ms a frame, {how}; {costs}"));
        }
        Ok(())
    }

    fn fail(&mut self, events: &ActiveEventLoop, failure: Failure) {
        self.failure = Some(failure);
        events.exit();
    }
}
