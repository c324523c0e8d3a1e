//! Sessions with a clock that is set by hand and a canvas in memory.

mod limits;
mod mates;
mod mending;
mod reading;
mod schedule;
mod zoom;

use crate::viewer::CanvasPicture;
use crate::{Report, Screen, Session};
use lsystem::render::Pane;
use lsystem::{Definition, View, Viewport};
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// Small enough for quick tests, large enough for several looks at the clock.
const VIEWPORT: Viewport = Viewport { width: 160, height: 120, ratio: 1.0 };

/// A canvas in memory.
#[derive(Default)]
struct Pixels {
    size: [u32; 2],
    /// RGBA.
    pixels: Vec<u8>,
    /// Whether the canvas refuses everything.
    refuses: bool,
}

/// A canvas that a test can look at.
#[derive(Clone, Default)]
struct Sheet(Rc<RefCell<Pixels>>);

impl Sheet {
    fn pixels(&self) -> Vec<u8> {
        self.0.borrow().pixels.clone()
    }
}

/// The canvas refuses the pixels.
#[derive(Debug, PartialEq)]
struct Refused;

impl Screen for Sheet {
    type Error = Refused;

    fn put(&mut self, pixels: &[u8], viewport: Viewport, pane: Pane) -> Result<(), Refused> {
        let mut screen = self.0.borrow_mut();
        if screen.refuses {
            return Err(Refused);
        }
        let size = [viewport.width, viewport.height];
        if screen.size != size {
            screen.size = size;
            screen.pixels = vec![0; (4 * size[0] * size[1]) as usize];
        }
        let width = 4 * pane.width as usize;
        assert_eq!(pixels.len(), width * pane.height as usize);
        for (row, y) in pixels.chunks(width).zip(pane.y..) {
            let start = 4 * (y * size[0] + pane.x) as usize;
            screen.pixels[start..start + width].copy_from_slice(row);
        }
        Ok(())
    }
}

/// A clock that goes on by some milliseconds with each look at it, and its present time.
#[derive(Clone, Default)]
struct Hand {
    now: Rc<Cell<f64>>,
    tick: Rc<Cell<f64>>,
}

/// A session, its canvas and its clock.
struct Bench {
    session: Session<Sheet>,
    screen: Sheet,
    hand: Hand,
}

impl Bench {
    fn of(make: fn(Sheet, crate::Clock) -> Session<Sheet>) -> Self {
        let (screen, hand) = (Sheet::default(), Hand::default());
        let Hand { now, tick } = hand.clone();
        let clock = Box::new(move || {
            now.set(now.get() + tick.get());
            now.get()
        });
        let mut session = make(screen.clone(), clock);
        session.look(VIEWPORT, View::default(), None);
        Self { session, screen, hand }
    }

    fn new() -> Self {
        Self::of(Session::new)
    }

    /// With this definition, and this many milliseconds between two looks at the clock.
    fn with(definition: &Definition, tick: f64) -> Self {
        let mut bench = Self::new();
        bench.tick(tick);
        assert!(bench.session.define(definition.clone()).ok);
        bench
    }

    fn tick(&mut self, tick: f64) {
        self.hand.tick.set(tick);
    }

    /// Builds the drawing, without a picture.
    fn build(&mut self) {
        while !self.session.built() {
            self.session.build();
        }
    }

    /// Works until the session is idle. Returns the pictures, and the last report.
    fn settle(&mut self) -> (Vec<CanvasPicture>, Option<Report>) {
        let (mut pictures, mut last) = (vec![], None);
        for _ in 0..100_000 {
            let answer = self.session.step().unwrap();
            pictures.extend(answer.drawn);
            last = answer.report.cloned().or(last);
            if answer.idle {
                return (pictures, last);
            }
        }
        panic!("the session is not idle after 100,000 steps");
    }
}

fn definition(axiom: &str, rules: &str, angle: f64, iterations: u32) -> Definition {
    Definition { axiom: axiom.into(), rules: rules.into(), angle, iterations, ..Definition::default() }
}

/// 5^n segments in n + 1 blocks.
fn weed(n: u32) -> Definition {
    definition("F", "F -> F[+F]F[-F]F", 25.7, n)
}

/// A bush in space, with shared blocks.
fn bush(n: u32) -> Definition {
    let dialect = lsystem::Dialect::Practical;
    Definition { dialect, ..definition("T", "T -> TF\nF -> F[+F][-FF][<F][>FF][&F]", 40.0, n) }
}

/// A tree by chance, with 2^n segments in as many blocks: slow to build, and slow to paint.
fn random(n: u32) -> Definition {
    definition("F", "F -> FF : 0.5\nF -> F[+F] : 0.5", 20.0, n)
}
