//! The demo's table.

use super::Method;
use super::timing::MethodTimes;
use crate::args::DemoArgs;
use crate::commands::command_line;
use crate::failure::Failure;
use glam::{UVec2, Vec4};
use serde::Serialize;
use std::time::SystemTime;
use straightline_bench::execute::{Clock, Times};
use straightline_kernels::prelude::Frame;
use straightline_oracle::metrics;
use straightline_oracle::oracle::{self, SraaParams};
use straightline_table::{Cell, Table};

/// A row of the table.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    method: String,
    texture_reads: Option<u32>,
    weight_evaluations: Option<u32>,
    looped: Option<Times>,
    unrolled: Option<Times>,
    ratio: Option<f64>,
    /// Milliseconds of a whole frame: geometry, shading and filter.
    frame_ms: Option<f64>,
    psnr_db: f64,
    largest_difference_to_f64: Option<f64>,
}

impl Row {
    /// Row of a picture without a filter.
    pub fn plain(method: &str, frame: &Frame<Vec4>, reference: &Frame<Vec4>) -> Row {
        Row {
            method: method.to_owned(),
            texture_reads: None,
            weight_evaluations: None,
            looped: None,
            unrolled: None,
            ratio: None,
            frame_ms: None,
            psnr_db: metrics::psnr(frame, reference),
            largest_difference_to_f64: None,
        }
    }

    /// The row with the time of its frame.
    pub fn with_frame(self, frame_ms: Option<f64>) -> Row {
        Row { frame_ms, ..self }
    }

    /// Row of a filter.
    pub fn measured(
        method: &Method,
        resolved: &Frame<Vec4>,
        times: &MethodTimes,
        reference: &Frame<Vec4>,
    ) -> Result<Row, Failure> {
        let counts = &method.unrolled.counts;
        let params = SraaParams::from_options(&method.unrolled.options).map_err(Failure::from_error)?;
        let exact = oracle::resolve_sraa(&method.inputs, &params).map_err(Failure::from_error)?;
        let exact: Vec<[f64; 4]> = exact.into_iter().map(|pixel| pixel.color).collect();
        Ok(Row {
            texture_reads: Some(counts.texture_reads + counts.colour_reads),
            weight_evaluations: counts.tallies.get("weight_evaluations").copied(),
            ratio: Some(times.looped.median_ms / times.unrolled.median_ms),
            looped: Some(times.looped.clone()),
            unrolled: Some(times.unrolled.clone()),
            largest_difference_to_f64: Some(metrics::max_abs_difference_to(resolved, &exact)),
            ..Row::plain(method.name, resolved, reference).with_frame(times.frame_ms)
        })
    }
}

/// The table with its circumstances.
#[derive(Debug, Serialize)]
pub struct Record {
    command: String,
    date: String,
    scene: String,
    size: [u32; 2],
    executor: String,
    clock: Clock,
    reference: String,
    rows: Vec<Row>,
}

impl Record {
    pub fn new(args: &DemoArgs, size: UVec2, executor: String, clock: Clock, rows: Vec<Row>) -> Record {
        let mesh = args.mesh.as_ref().map(|path| path.display().to_string());
        Record {
            command: command_line(),
            date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
            scene: mesh.unwrap_or_else(|| "built-in".to_owned()),
            size: size.to_array(),
            executor,
            clock,
            reference: "256x supersampling, PSNR over linear RGB clamped to 0..1".to_owned(),
            rows,
        }
    }

    pub fn print(&self, args: &DemoArgs) -> Result<(), Failure> {
        if args.json {
            outln!("{}", serde_json::to_string_pretty(self).map_err(Failure::from_error)?);
            return Ok(());
        }
        let ms = |ms: f64| Cell::fixed(ms, 2).suffixed(" ms");
        let median = |times: &Option<Times>| times.as_ref().map(|times| ms(times.median_ms));
        let table = Table::of(&self.rows)
            .column("method", |row| &row.method)
            .column("reads", |row| row.texture_reads)
            .column("weights", |row| row.weight_evaluations)
            .column("looped", |row| median(&row.looped))
            .column("unrolled", |row| median(&row.unrolled))
            .column("ratio", |row| {
                row.ratio.map(|ratio| Cell::fixed(ratio, 1).suffixed("x"))
            })
            .column("frame", |row| row.frame_ms.map(ms))
            .column("PSNR", |row| Cell::fixed(row.psnr_db, 2).suffixed(" dB"))
            .scientific("off f64 by", 1, |row| row.largest_difference_to_f64)
            .finish();
        outln!("\n{}", table.to_text());
        let with = match self.clock {
            Clock::GpuTimestamps => "GPU timestamps, passes in turn",
            Clock::WallClock => "wall clock, passes in turn",
        };
        outln!(
            "{}x{} on {}; medians by {with}.",
            self.size[0],
            self.size[1],
            self.executor
        );
        outln!("A frame is geometry, shading and the unrolled filter.");
        outln!("PSNR is against {}.", self.reference);
        outln!(
            "Open {} to compare the pictures.",
            args.out.join("detail.png").display()
        );
        Ok(())
    }
}
