//! Pieces joined end to end into as few polylines as possible.
//!
//! The ends of the pieces are the nodes of a graph. A polyline is a trail in this graph: it takes every piece once.
//! A connected part with 2k nodes of odd degree needs k trails, or one if there are none (Euler 1736). The trails start
//! at nodes of odd degree, and the closed trails that are left are inserted where they touch others (Hierholzer 1873).

use super::cells::Cells;
use super::merge::{JOINT, Piece};
use super::page::{Point, distance};
use lsystem_syntax::{Meter, Progress};

/// The most pieces at a node that are compared to find the straightest way on.
const COMPARED: usize = 16;
/// The largest sine of the angle between two pieces that count as one.
const STRAIGHT: f64 = 1e-6;
/// No piece.
const NONE: u32 = u32::MAX;

/// Points joined by lines of one layer.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Polylines {
    pub(super) points: Vec<Point>,
    /// The layer and the end of each polyline in `points`; it starts where the one before ends.
    pub(super) list: Vec<(u32, usize)>,
}

impl Polylines {
    pub(super) fn layer(&self, number: usize) -> u32 {
        self.list[number].0
    }

    pub(super) fn points_of(&self, number: usize) -> &[Point] {
        let start = if number == 0 { 0 } else { self.list[number - 1].1 };
        &self.points[start..self.list[number].1]
    }

    /// The first and the last point.
    pub(super) fn ends(&self, number: usize) -> [Point; 2] {
        let points = self.points_of(number);
        [points[0], points[points.len() - 1]]
    }

    pub(super) fn is_closed(&self, number: usize) -> bool {
        let [start, end] = self.ends(number);
        start == end
    }
}

/// Joins pieces in steps.
#[derive(Clone, Debug)]
pub(super) struct Join {
    pieces: Vec<Piece>,
    least: f64,
    cells: Cells,
    /// The position of each node.
    nodes: Vec<Point>,
    /// The nodes of each piece.
    ends: Vec<[u32; 2]>,
    /// The number of pieces at each node that are not in a trail.
    free: Vec<u32>,
    /// The range of each node in `around`: its start, and the end of the part that is not known to be taken.
    starts: Vec<u32>,
    limits: Vec<u32>,
    /// The pieces at each node.
    around: Vec<u32>,
    /// By piece: whether it is in a trail, whether it leads from its second end to its first, and the next piece.
    taken: Vec<bool>,
    flipped: Vec<bool>,
    next: Vec<u32>,
    /// The first piece of each trail.
    heads: Vec<u32>,
    /// All earlier pieces are in trails.
    closed_from: usize,
    stage: Stage,
    /// The trail being walked.
    walk: Option<Walk>,
    polylines: Polylines,
}

/// A trail being walked: its first and its last piece, the node reached, and the piece after which the trail is
/// inserted.
#[derive(Clone, Copy, Debug)]
struct Walk {
    first: u32,
    last: u32,
    node: u32,
    into: Target,
}

/// Where a finished trail goes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Target {
    /// A trail of its own.
    New,
    /// Before the first piece of the trail with this number.
    Before(usize),
    /// Behind this piece.
    Behind(u32),
}

#[derive(Clone, Copy, Debug)]
enum Stage {
    /// Numbering the ends of this piece.
    Number(usize),
    /// Adding up the degrees to ranges, from this node on.
    Range(usize),
    /// Listing this piece at its nodes.
    List(usize),
    /// Starting trails at this node if its degree is odd.
    Odd(usize),
    /// Inserting closed trails into the trail with this number, behind this piece or before its first piece.
    Insert(usize, u32),
    /// Starting a closed trail with this piece.
    Closed(usize),
    /// Writing the points of the trail with this number, from this piece on.
    Write(usize, u32),
    Done,
}

impl Join {
    /// Prepares the joining. Polylines shorter than `least` are left out.
    pub(super) fn new(pieces: Vec<Piece>, least: f64) -> Self {
        Self {
            pieces,
            least,
            cells: Cells::new([JOINT; 2]),
            nodes: Vec::new(),
            ends: Vec::new(),
            free: Vec::new(),
            starts: Vec::new(),
            limits: Vec::new(),
            around: Vec::new(),
            taken: Vec::new(),
            flipped: Vec::new(),
            next: Vec::new(),
            heads: Vec::new(),
            closed_from: 0,
            stage: Stage::Number(0),
            walk: None,
            polylines: Polylines::default(),
        }
    }

    /// Continues until the meter is spent.
    pub(super) fn step(&mut self, meter: &mut Meter) -> Progress {
        while !meter.is_spent() {
            meter.charge(2);
            if let Some(walk) = self.walk.take() {
                self.walk_on(walk, meter);
                continue;
            }
            self.stage = match self.stage {
                Stage::Number(piece) => self.number(piece),
                Stage::Range(node) => self.range(node),
                Stage::List(piece) => self.list(piece),
                Stage::Odd(node) if node == self.nodes.len() => self.insert_into(0),
                Stage::Odd(node) if self.free[node] % 2 == 1 => {
                    self.start(node as u32, Target::New);
                    self.stage
                }
                Stage::Odd(node) => Stage::Odd(node + 1),
                Stage::Insert(trail, behind) => self.insert(trail, behind),
                Stage::Closed(piece) if piece == self.pieces.len() => self.write_from(0),
                Stage::Closed(piece) if self.taken[piece] => Stage::Closed(piece + 1),
                Stage::Closed(piece) => {
                    self.closed_from = piece;
                    self.start(self.ends[piece][0], Target::New);
                    Stage::Insert(self.heads.len(), NONE)
                }
                Stage::Write(trail, piece) => self.write(trail, piece),
                Stage::Done => return Progress::Done,
            };
        }
        Progress::More
    }

    /// The polylines, after all steps.
    pub(super) fn finish(self) -> Polylines {
        self.polylines
    }

    fn number(&mut self, piece: usize) -> Stage {
        let Some(&Piece { layer, ends }) = self.pieces.get(piece) else {
            self.cells = Cells::new([JOINT; 2]);
            self.taken = vec![false; self.pieces.len()];
            self.flipped = vec![false; self.pieces.len()];
            self.next = vec![NONE; self.pieces.len()];
            self.around = vec![0; 2 * self.pieces.len()];
            return Stage::Range(0);
        };
        let nodes = ends.map(|end| {
            let (node, is_new) = self.cells.number(layer, end);
            if is_new {
                self.nodes.push(end);
                self.free.push(0);
            }
            self.free[node as usize] += 1;
            node
        });
        self.ends.push(nodes);
        Stage::Number(piece + 1)
    }

    fn range(&mut self, node: usize) -> Stage {
        if node == self.nodes.len() {
            return Stage::List(0);
        }
        let start = if node == 0 { 0 } else { self.starts[node - 1] + self.free[node - 1] };
        self.starts.push(start);
        self.limits.push(start);
        Stage::Range(node + 1)
    }

    fn list(&mut self, piece: usize) -> Stage {
        let Some(&ends) = self.ends.get(piece) else { return Stage::Odd(0) };
        for node in ends {
            let limit = &mut self.limits[node as usize];
            self.around[*limit as usize] = piece as u32;
            *limit += 1;
        }
        Stage::List(piece + 1)
    }

    /// Starts a trail at a node that has free pieces.
    fn start(&mut self, node: u32, into: Target) {
        self.walk = Some(Walk { first: NONE, last: NONE, node, into });
    }

    /// Adds the next piece to a trail, or ends the trail.
    fn walk_on(&mut self, mut walk: Walk, meter: &mut Meter) {
        match self.take(walk.node, walk.last, meter) {
            Some(piece) => {
                if walk.last == NONE {
                    walk.first = piece;
                } else {
                    self.next[walk.last as usize] = piece;
                }
                walk.last = piece;
                walk.node = self.end(piece);
                self.walk = Some(walk);
            }
            None if walk.first == NONE => {}
            None => match walk.into {
                Target::New => self.heads.push(walk.first),
                Target::Before(trail) => {
                    self.next[walk.last as usize] = self.heads[trail];
                    self.heads[trail] = walk.first;
                }
                Target::Behind(piece) => {
                    self.next[walk.last as usize] = self.next[piece as usize];
                    self.next[piece as usize] = walk.first;
                }
            },
        }
    }

    /// Takes a free piece at a node: the one that leads most straight on from `last`.
    fn take(&mut self, node: u32, last: u32, meter: &mut Meter) -> Option<u32> {
        let [start, at] = [self.starts[node as usize], node].map(|value| value as usize);
        let from = (last != NONE).then(|| self.way(last));
        let (mut best, mut best_turn) = (None, f64::INFINITY);
        let (mut slot, mut compared) = (start, 0);
        while slot < self.limits[at] as usize && compared < COMPARED {
            meter.charge(1);
            let piece = self.around[slot];
            if self.taken[piece as usize] {
                self.limits[at] -= 1;
                self.around.swap(slot, self.limits[at] as usize);
                continue;
            }
            let own = self.way_from(piece, node);
            let turn = from.map_or(0.0, |from| -(from[0] * own[0] + from[1] * own[1]));
            if turn < best_turn {
                (best, best_turn) = (Some(piece), turn);
            }
            (slot, compared) = (slot + 1, compared + 1);
        }
        let piece = best?;
        self.taken[piece as usize] = true;
        self.flipped[piece as usize] = self.ends[piece as usize][0] != node;
        self.ends[piece as usize].iter().for_each(|&end| self.free[end as usize] -= 1);
        Some(piece)
    }

    /// The direction of a piece that starts at a node.
    fn way_from(&self, piece: u32, node: u32) -> Point {
        let Piece { ends: [from, to], .. } = self.pieces[piece as usize];
        let sign = if self.ends[piece as usize][0] == node { 1.0 } else { -1.0 } / distance(from, to);
        [0, 1].map(|axis| sign * (to[axis] - from[axis]))
    }

    /// The direction of a piece in its trail.
    fn way(&self, piece: u32) -> Point {
        self.way_from(piece, self.begin(piece))
    }

    fn begin(&self, piece: u32) -> u32 {
        self.ends[piece as usize][usize::from(self.flipped[piece as usize])]
    }

    fn end(&self, piece: u32) -> u32 {
        self.ends[piece as usize][usize::from(!self.flipped[piece as usize])]
    }

    /// The stage that inserts closed trails into a trail, or the next stage if there is no such trail.
    fn insert_into(&self, trail: usize) -> Stage {
        if trail < self.heads.len() { Stage::Insert(trail, NONE) } else { Stage::Closed(self.closed_from) }
    }

    /// Inserts a closed trail at a node of a trail, or goes on along the trail.
    fn insert(&mut self, trail: usize, behind: u32) -> Stage {
        let Some(&head) = self.heads.get(trail) else { return Stage::Closed(self.closed_from) };
        let (node, into) = match behind {
            NONE => (self.begin(head), Target::Before(trail)),
            piece => (self.end(piece), Target::Behind(piece)),
        };
        if self.free[node as usize] > 0 {
            self.start(node, into);
            return Stage::Insert(trail, behind);
        }
        match behind {
            NONE => Stage::Insert(trail, head),
            piece if self.next[piece as usize] != NONE => Stage::Insert(trail, self.next[piece as usize]),
            _ => self.insert_into(trail + 1),
        }
    }

    fn write_from(&self, trail: usize) -> Stage {
        self.heads.get(trail).map_or(Stage::Done, |&head| Stage::Write(trail, head))
    }

    /// Writes the points of a piece. Pieces that lead straight on become one.
    fn write(&mut self, trail: usize, piece: u32) -> Stage {
        let start = self.polylines.list.last().map_or(0, |&(_, end)| end);
        let [from, to] = [self.begin(piece), self.end(piece)].map(|node| self.nodes[node as usize]);
        let points = &mut self.polylines.points;
        if points.len() == start {
            points.push(from);
        } else if points.len() - start >= 2 && goes_on([points[points.len() - 2], from, to]) {
            points.pop();
        }
        points.push(to);
        let next = self.next[piece as usize];
        if next != NONE {
            return Stage::Write(trail, next);
        }
        let length: f64 = points[start..].windows(2).map(|pair| distance(pair[0], pair[1])).sum();
        if length < self.least || length == 0.0 {
            points.truncate(start);
        } else {
            self.polylines.list.push((self.pieces[piece as usize].layer, points.len()));
        }
        self.write_from(trail + 1)
    }
}

/// Whether the way through three points is straight.
fn goes_on([a, b, c]: [Point; 3]) -> bool {
    let ([p, q], [r, s]) = ([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]);
    p * r + q * s > 0.0 && (p * s - q * r).abs() <= STRAIGHT * distance(a, b) * distance(b, c)
}
