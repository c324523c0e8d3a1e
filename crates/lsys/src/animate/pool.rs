//! Frames on all cores, taken in order. Few frames are in memory at a time.

use super::WORK;
use crate::progress::DelayedBar;
use crate::{CommandFailure, cores, memory};
use lsystem::base::{LimitName, say};
use lsystem::film::{Film, LIMITS, Painter};
use lsystem::render::Detail;
use lsystem::{Diagnostic, Limits, Progress, render_diagnostic};
use std::collections::BTreeMap;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError, mpsc};
use std::thread;

/// The most bytes of a worker for a pixel: 24 while it is painted, and up to three finished frames as pixels or files.
const FRAME_PIXEL: u64 = 40;
/// The bytes of a worker for everything else.
const FRAME_BYTES: u64 = 16 << 20;

/// The workers on a film.
pub(super) struct Pool<'a> {
    pub(super) film: &'a Film,
    limits: Limits,
    workers: usize,
    /// The bytes of memory that a drawing may take: at least the limit, or less if there is less.
    free: u64,
}

/// The frames that are given to workers and taken from them.
#[derive(Default)]
struct Window {
    next: u32,
    taken: u32,
    is_over: bool,
}

impl<'a> Pool<'a> {
    /// A worker for each core, or as many as there is memory for; one worker if a drawing may take more memory than
    /// usual.
    ///
    /// # Errors
    /// [`CommandFailure::Limit`] if there is not enough memory for one.
    pub(super) fn new(film: &'a Film, limits: Limits) -> Result<Self, CommandFailure> {
        let most = if limits.memory > LIMITS.memory { 1 } else { cores::count().min(film.frames() as usize).max(1) };
        let [width, height] = film.script().size.map(u64::from);
        let frame = FRAME_BYTES + width * height * FRAME_PIXEL;
        let is_enough = |workers: &usize| memory::check(frame * *workers as u64).is_ok();
        let workers = (1..=most).rev().find(is_enough);
        let workers = workers.map_or_else(|| memory::check(frame).map(|()| 1), Ok)?;
        let free = memory::at_most(workers as u64 * (frame + limits.memory)).saturating_sub(workers as u64 * frame);
        Ok(Self { film, limits, workers, free: free / workers as u64 })
    }

    /// Paints the frames with these numbers, makes a value of the pixels of each, and takes the values in order.
    pub(super) fn run<T: Send>(
        &self,
        numbers: &[u32],
        size: [u32; 2],
        label: &'static str,
        make: impl Fn(u32, &[u8]) -> Result<T, CommandFailure> + Sync,
        mut take: impl FnMut(u32, T) -> Result<(), CommandFailure>,
    ) -> Result<(), CommandFailure> {
        let window = Mutex::new(Window::default());
        let moved = Condvar::new();
        let most = 2 * self.workers as u32;
        let lock = || window.lock().unwrap_or_else(PoisonError::into_inner);
        let next = || {
            let wait = |window: &mut Window| !window.is_over && window.next >= window.taken + most;
            let mut window: MutexGuard<'_, Window> =
                moved.wait_while(lock(), wait).unwrap_or_else(PoisonError::into_inner);
            let number = numbers.get(window.next as usize).filter(|_| !window.is_over)?;
            window.next += 1;
            Some((window.next - 1, *number))
        };
        let worker = |sender: mpsc::Sender<_>| {
            let mut painter = Painter::new(self.limits);
            while let Some((at, number)) = next() {
                let made = self.paint(&mut painter, number, size).and_then(|()| make(number, painter.pixels()));
                let failed = made.is_err();
                if sender.send((at, made)).is_err() || failed {
                    break;
                }
            }
        };
        let over = |ending: Result<(), CommandFailure>| {
            lock().is_over = true;
            moved.notify_all();
            ending
        };
        let (sender, receiver) = mpsc::channel();
        thread::scope(|scope| {
            cores::start(scope, self.workers, || {
                let (sender, worker) = (sender.clone(), &worker);
                move || worker(sender)
            })?;
            drop(sender);
            let mut bar = DelayedBar::new(label, Some(numbers.len() as u64));
            let mut waiting = BTreeMap::new();
            let mut taken = 0;
            for (at, made) in receiver {
                waiting.insert(at, made);
                while let Some(made) = waiting.remove(&taken) {
                    if let Err(failure) = made.and_then(|value| take(numbers[taken as usize], value)) {
                        return over(Err(failure));
                    }
                    taken += 1;
                    lock().taken = taken;
                    moved.notify_all();
                    bar.at(u64::from(taken));
                }
            }
            over(Ok(()))
        })
    }

    /// Paints a frame.
    fn paint(&self, painter: &mut Painter, number: u32, size: [u32; 2]) -> Result<(), CommandFailure> {
        let wrong = |error| CommandFailure::Limit(render_diagnostic(&error, &say!("frame {} of the film", number), ""));
        painter.begin(&self.film.frame(number), size, Detail::Fine).map_err(wrong)?;
        while painter.step(WORK).map_err(wrong)? == Progress::More {
            if painter.drawing_bytes() > self.free {
                return Err(wrong(Diagnostic::limit(LimitName::Memory, self.free, None)));
            }
        }
        Ok(())
    }
}
