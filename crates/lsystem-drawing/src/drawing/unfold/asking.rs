//! The answers to queries: the turtle walks a word without drawing it.

use super::generations::TurtleOpReader;
use crate::drawing::task::Task;
use crate::exact_path::{Leg, Spot};
use crate::neighbours::{Crowd, Site, Sky};
use crate::room::bytes_of;
use crate::space::Geometry;
use crate::turtle::{Colouring, Paper, Pen, work_of};
use crate::{Solid, StyleChange, Turtle};
use lsystem_base::{Limits, Meter, Progress};
use lsystem_derive::{Fault, Interpret, Interpretation, LetterId, QueryAnswer, Rewriter};
use lsystem_syntax::Query;

/// Answers the queries of a system with this turtle. Growth and sway of the last generation do not count: they would
/// change what earlier generations have decided.
pub(crate) struct TurtleInterpreter {
    turtle: Turtle,
}

impl TurtleInterpreter {
    pub(crate) fn new(turtle: &Turtle) -> Self {
        Self { turtle: Turtle { growth: 1.0, wind: None, colouring: Colouring::Symbols, ..turtle.clone() } }
    }
}

impl Interpret for TurtleInterpreter {
    fn start(&self, rewriter: &Rewriter) -> Box<dyn Interpretation> {
        let (rules, turtle) = (rewriter.rules().clone(), self.turtle.clone());
        let score = turtle.score::<Solid>(&rules.drawn());
        let pen = Pen::start(&turtle, &score);
        let unit = libm::scalbn(score.step, score.exponent);
        let queries = (0..rules.letters.len()).map(|letter| rules.query(letter as LetterId)).collect();
        let (seed, n) = (rewriter.seed(), rewriter.generation());
        let task = Task { rules, turtle, score, seed, n, limits: Limits::default() };
        let reader = TurtleOpReader::of_all();
        let walk = DepthFirst {
            reader,
            pen,
            saved: vec![],
            queries,
            unit,
            crowd: vec![],
            sky: vec![],
            waiting: [vec![], vec![]],
        };
        Box::new(TurtleInterpretation { task, stage: Stage::DepthFirst(Box::new(walk)) })
    }

    fn needs_keys(&self) -> bool {
        self.turtle.angle_variation != 0.0 || self.turtle.length_variation != 0.0
    }
}

struct TurtleInterpretation {
    task: Task<Solid>,
    stage: Stage,
}

enum Stage {
    DepthFirst(Box<DepthFirst>),
    /// Counts neighbours, then light. The arguments of the modules that ask are in the order of the sites.
    Look(Box<Look>),
}

struct Look {
    crowd: Crowd,
    sky: Sky,
    waiting: [Vec<usize>; 2],
}

/// The turtle on its way.
struct DepthFirst {
    reader: TurtleOpReader<Solid>,
    pen: Pen<Solid>,
    saved: Vec<Pen<Solid>>,
    /// By letter.
    queries: Vec<Option<Query>>,
    /// One unit of the pen, in model units.
    unit: f64,
    crowd: Vec<Site>,
    sky: Vec<Site>,
    /// The index of the first argument of each site's module: for the crowd, and for the sky.
    waiting: [Vec<usize>; 2],
}

impl Interpretation for TurtleInterpretation {
    fn step(&mut self, rewriter: &Rewriter, answers: &mut Vec<QueryAnswer>, meter: &mut Meter) -> Result<bool, Fault> {
        match &mut self.stage {
            Stage::DepthFirst(walk) => {
                if walk.step(&self.task, rewriter, answers, meter)? {
                    let waiting = core::mem::take(&mut walk.waiting);
                    let crowd = Crowd::new(core::mem::take(&mut walk.crowd));
                    let sky = Sky::new(core::mem::take(&mut walk.sky));
                    self.stage = Stage::Look(Box::new(Look { crowd, sky, waiting }));
                }
                Ok(false)
            }
            Stage::Look(look) => {
                let Look { crowd, sky, waiting } = &mut **look;
                if crowd.step(meter) == Progress::More || sky.step(meter) == Progress::More {
                    return Ok(false);
                }
                let one =
                    |argument: &usize, value: f64| QueryAnswer { argument: *argument, count: 1, values: [value; 3] };
                let near = waiting[0].iter().zip(crowd.counts()).map(|(at, &count)| one(at, count.into()));
                answers.extend(near.chain(waiting[1].iter().zip(sky.light()).map(|(at, &light)| one(at, light))));
                Ok(true)
            }
        }
    }

    fn work(&self) -> u64 {
        match &self.stage {
            Stage::DepthFirst(_) => 0,
            Stage::Look(look) => look.crowd.work(),
        }
    }

    fn bytes(&self) -> u64 {
        let waiting = |lists: &[Vec<usize>; 2]| lists.iter().map(bytes_of).sum::<u64>();
        match &self.stage {
            Stage::DepthFirst(walk) => {
                bytes_of(&walk.saved) + bytes_of(&walk.crowd) + bytes_of(&walk.sky) + waiting(&walk.waiting)
            }
            Stage::Look(look) => look.crowd.bytes() + look.sky.bytes() + waiting(&look.waiting),
        }
    }
}

impl DepthFirst {
    fn step(
        &mut self,
        task: &Task<Solid>,
        rewriter: &Rewriter,
        answers: &mut Vec<QueryAnswer>,
        meter: &mut Meter,
    ) -> Result<bool, Fault> {
        let Self { reader, pen, saved, queries, unit, crowd, sky, waiting } = self;
        let word = rewriter.word();
        let start = task.turtle.start;
        reader.read(rewriter, task, meter, &mut |place, argument, ops| {
            if !ops.is_empty() {
                pen.act(ops, saved, 1.0, &mut Solid::directions(), &mut NoPaper);
                return Some(work_of(ops));
            }
            let letter = usize::from(word.letters[place]);
            let Some(query) = queries[letter] else { return Some(0) };
            let at = [start[0] + pen.at[0] * *unit, start[1] + pen.at[1] * *unit, pen.at[2] * *unit];
            let arity = task.rules.arity(letter as LetterId);
            let size = if arity > 1 { word.arguments[argument + 1] } else { task.score.step };
            let axis = |direction: [f64; 3]| {
                Solid::transform(&Solid::axes(&mut Solid::directions(), pen.heading), [0.0; 3], direction)
            };
            let values = match query {
                Query::Position => at,
                Query::Heading => axis([1.0, 0.0, 0.0]),
                Query::Left => axis([0.0, 1.0, 0.0]),
                Query::Up => axis([0.0, 0.0, 1.0]),
                Query::Crowd | Query::Sky => {
                    let (sites, waiting) = if query == Query::Crowd {
                        (&mut *crowd, &mut waiting[0])
                    } else {
                        (&mut *sky, &mut waiting[1])
                    };
                    sites.push(Site { at, size });
                    waiting.push(argument);
                    return Some(1);
                }
            };
            answers.push(QueryAnswer { argument, count: arity.min(query.answers()) as u8, values });
            Some(1)
        })
    }
}

/// Paper on which nothing is drawn.
struct NoPaper;

impl Paper<Solid> for NoPaper {
    fn go(&mut self, _: Leg<Solid>) -> Spot {
        Spot::ENTRY
    }
    fn stroke(&mut self, _: [[f64; 3]; 2], _: Spot, _: &StyleChange) {}
    fn side(&mut self, _: [[f64; 3]; 2], _: Spot, _: &StyleChange) {}
    fn tube(&mut self, _: [[f64; 3]; 2], _: &StyleChange) {}
    fn gap(&mut self) {}
    fn branch(&mut self) {}
    fn rejoin(&mut self) {}
    fn open(&mut self, _: &StyleChange) {}
    fn first_vertex(&mut self, _: [f64; 3], _: Spot) {}
    fn vertex(&mut self, _: [f64; 3], _: Spot) {}
    fn close(&mut self) {}
}
