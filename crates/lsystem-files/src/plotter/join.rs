//! Pieces joined end to end into as few polylines as possible.
//!
//! The ends of the pieces are the nodes of a graph. A polyline is a trail in this graph: it takes every piece once.
//! A connected part with 2k nodes of odd degree needs k trails, or one if there are none (Euler 1736). The nodes of odd
//! degree are joined in pairs by moves of the raised pen, with little travel in all. Then the graph has closed trails
//! (Hierholzer 1873); the moves part them into polylines, and the order along a closed trail has no other travel.
//!
//! A move of at most a pen's width is drawn: the round ends of two lines touch there, and to raise the pen takes longer.
//! So is a move of a few pens that leads over ink. All these moves together are no longer than the ink that the cut saved.

use super::cells::Cells;
use super::ink::Ink;
use super::merge::{JOINT, Piece};
use super::options::PlotOptions;
use super::page::{Point, distance};
use super::pair::Pair;
use super::spots::Spots;
use lsystem_syntax::{Meter, Progress};

/// The most pieces at a node that are compared to find the straightest way on.
const COMPARED: usize = 16;
/// The largest sine of the angle between two pieces that count as one.
const STRAIGHT: f64 = 1e-6;
/// Moves are taken last: their turn is greater than that of a piece that leads straight back.
const MOVE: f64 = 2.0;
/// The longest move that is drawn if it leads over ink, in pens. At the usual speeds, that takes a tenth of the time to
/// raise and lower the pen.
const OVER_INK: f64 = 4.0;
/// No piece.
const NONE: u32 = u32::MAX;

/// Points joined by lines of one layer.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Polylines {
    pub(super) points: Vec<Point>,
    /// The layer and the end of each polyline in `points`; it starts where the one before ends.
    pub(super) list: Vec<(u32, usize)>,
    /// By polyline: the number of its closed trail. The polylines of a closed trail follow each other.
    pub(super) trails: Vec<u32>,
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
    /// The length under which polylines are left out.
    least: f64,
    pen: f64,
    spots: Spots,
    /// The length of the moves that may still be drawn.
    spare: f64,
    size: [f64; 2],
    /// The nodes of the moves so far.
    moves: Vec<[u32; 2]>,
    cells: Cells,
    /// The position and the layer of each node.
    nodes: Vec<(Point, u32)>,
    /// The nodes of each piece, then those of each move.
    ends: Vec<[u32; 2]>,
    /// The number of pieces and moves at each node that are not in a trail.
    free: Vec<u32>,
    /// The range of each node in `around`: its start, and the end of the part that is not known to be taken.
    starts: Vec<u32>,
    limits: Vec<u32>,
    /// The pieces and moves at each node.
    around: Vec<u32>,
    /// By piece or move: whether it is in a trail, whether it leads from its second end to its first, and the next one.
    taken: Vec<bool>,
    flipped: Vec<bool>,
    next: Vec<u32>,
    /// The first piece or move of each closed trail.
    heads: Vec<u32>,
    stage: Stage,
    /// The trail being walked.
    walk: Option<Walk>,
    polylines: Polylines,
}

/// A trail being walked: its first and its last piece, the node reached, and the piece behind which the trail is
/// inserted; [`NONE`] for a trail of its own.
#[derive(Clone, Copy, Debug)]
struct Walk {
    first: u32,
    last: u32,
    node: u32,
    behind: u32,
}

#[derive(Clone, Debug)]
enum Stage {
    /// Numbering the ends of this piece.
    Number(usize),
    /// Looking for odd degrees, from this node on: the nodes found, by layer.
    Odd(usize, Vec<Vec<u32>>),
    /// Pairing the nodes of a layer, with those of the layers that follow.
    Pair(Box<Pair>, Vec<u32>, std::vec::IntoIter<Vec<u32>>),
    /// Adding up the degrees to ranges, from this node on.
    Range(usize),
    /// Listing this piece or move at its nodes.
    List(usize),
    /// Starting a closed trail with the piece or move before this one.
    Start(usize),
    /// Inserting closed trails into the last trail, behind this piece. All pieces from this number on are in trails.
    Insert(usize, u32),
    /// Writing the points of the trail with this number, from this piece on.
    Write(usize, u32),
    Done,
}

impl Join {
    /// Prepares the joining of ink on a sheet of this size.
    pub(super) fn new(ink: Ink, options: &PlotOptions, size: [f64; 2]) -> Self {
        Self {
            pieces: ink.pieces,
            least: options.least,
            pen: options.pen,
            spots: ink.spots,
            spare: ink.spare,
            size,
            moves: Vec::new(),
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
            self.stage = match core::mem::replace(&mut self.stage, Stage::Done) {
                Stage::Number(piece) => self.number(piece),
                Stage::Odd(node, odd) => self.find_odd(node, odd),
                Stage::Pair(mut pair, nodes, rest) => match pair.step(meter) {
                    Progress::More => Stage::Pair(pair, nodes, rest),
                    Progress::Done => {
                        for [a, b] in pair.finish() {
                            let ends = [nodes[a as usize], nodes[b as usize]];
                            ends.iter().for_each(|&node| self.free[node as usize] += 1);
                            self.add_move(ends);
                        }
                        self.pair(rest)
                    }
                },
                Stage::Range(node) => self.range(node),
                Stage::List(piece) => self.list(piece),
                Stage::Start(0) => self.write_from(0),
                Stage::Start(piece) => self.start(piece - 1),
                Stage::Insert(rest, behind) => self.insert(rest, behind),
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
            return Stage::Odd(0, Vec::new());
        };
        let nodes = ends.map(|end| {
            let (node, is_new) = self.cells.number(layer, end);
            if is_new {
                self.nodes.push((end, layer));
                self.free.push(0);
            }
            self.free[node as usize] += 1;
            node
        });
        self.ends.push(nodes);
        Stage::Number(piece + 1)
    }

    fn find_odd(&mut self, node: usize, mut odd: Vec<Vec<u32>>) -> Stage {
        let Some(&(_, layer)) = self.nodes.get(node) else { return self.pair(odd.into_iter()) };
        if self.free[node] % 2 == 1 {
            odd.resize(odd.len().max(layer as usize + 1), Vec::new());
            odd[layer as usize].push(node as u32);
        }
        Stage::Odd(node + 1, odd)
    }

    /// Begins to pair the nodes of the next layer, or to list the pieces at each node.
    fn pair(&mut self, mut rest: std::vec::IntoIter<Vec<u32>>) -> Stage {
        if let Some(nodes) = rest.next() {
            let points = nodes.iter().map(|&node| self.nodes[node as usize].0).collect();
            return Stage::Pair(Box::new(Pair::new(points, self.size)), nodes, rest);
        }
        self.ends.append(&mut self.moves);
        let count = self.ends.len();
        self.taken = vec![false; count];
        self.flipped = vec![false; count];
        self.next = vec![NONE; count];
        self.around = vec![0; 2 * count];
        Stage::Range(0)
    }

    /// Adds a move between two nodes, or a piece if the move is short and ink is spare.
    fn add_move(&mut self, nodes: [u32; 2]) {
        let [(from, layer), (to, _)] = nodes.map(|node| self.nodes[node as usize]);
        let length = distance(from, to);
        let pens = length / self.pen;
        if length <= self.spare && (pens <= 1.0 || pens <= OVER_INK && self.spots.has(layer, [from, to])) {
            self.spare -= length;
            self.pieces.push(Piece { layer, ends: [from, to] });
            self.ends.push(nodes);
        } else {
            self.moves.push(nodes);
        }
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
        let Some(&ends) = self.ends.get(piece) else { return Stage::Start(self.ends.len()) };
        for node in ends {
            let limit = &mut self.limits[node as usize];
            self.around[*limit as usize] = piece as u32;
            *limit += 1;
        }
        Stage::List(piece + 1)
    }

    /// Starts a closed trail with a piece or move, unless it is in one. Moves come first, so that a trail with moves
    /// starts with one.
    fn start(&mut self, piece: usize) -> Stage {
        if self.taken[piece] {
            return Stage::Start(piece);
        }
        let number = piece as u32;
        self.put(number, self.ends[piece][0]);
        self.walk = Some(Walk { first: number, last: number, node: self.end(number), behind: NONE });
        Stage::Insert(piece, NONE)
    }

    /// Notes that a piece is in a trail, which enters it at a node.
    fn put(&mut self, piece: u32, node: u32) {
        self.taken[piece as usize] = true;
        self.flipped[piece as usize] = self.ends[piece as usize][0] != node;
        self.ends[piece as usize].iter().for_each(|&end| self.free[end as usize] -= 1);
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
            None if walk.behind == NONE => self.heads.push(walk.first),
            None => {
                self.next[walk.last as usize] = self.next[walk.behind as usize];
                self.next[walk.behind as usize] = walk.first;
            }
        }
    }

    /// Takes a free piece at a node: the one that leads most straight on from `last`, or else a move.
    fn take(&mut self, node: u32, last: u32, meter: &mut Meter) -> Option<u32> {
        let at = node as usize;
        let from = if last == NONE { None } else { self.way_from(last, self.begin(last)) };
        let (mut best, mut best_turn) = (None, f64::INFINITY);
        let (mut slot, mut compared) = (self.starts[at] as usize, 0);
        while slot < self.limits[at] as usize && compared < COMPARED {
            meter.charge(1);
            let piece = self.around[slot];
            if self.taken[piece as usize] {
                self.limits[at] -= 1;
                self.around.swap(slot, self.limits[at] as usize);
                continue;
            }
            let turn = match (from, self.way_from(piece, node)) {
                (Some(from), Some(own)) => -(from[0] * own[0] + from[1] * own[1]),
                (None, Some(_)) => 0.0,
                (_, None) => MOVE,
            };
            if turn < best_turn {
                (best, best_turn) = (Some(piece), turn);
            }
            (slot, compared) = (slot + 1, compared + 1);
        }
        let piece = best?;
        self.put(piece, node);
        Some(piece)
    }

    /// The direction of a piece that starts at a node; `None` for a move.
    fn way_from(&self, piece: u32, node: u32) -> Option<Point> {
        let Piece { ends: [from, to], .. } = *self.pieces.get(piece as usize)?;
        let sign = if self.ends[piece as usize][0] == node { 1.0 } else { -1.0 } / distance(from, to);
        Some([0, 1].map(|axis| sign * (to[axis] - from[axis])))
    }

    fn begin(&self, piece: u32) -> u32 {
        self.ends[piece as usize][usize::from(self.flipped[piece as usize])]
    }

    fn end(&self, piece: u32) -> u32 {
        self.ends[piece as usize][usize::from(!self.flipped[piece as usize])]
    }

    /// Inserts a closed trail behind a piece of the last trail, or goes on along the trail.
    fn insert(&mut self, rest: usize, behind: u32) -> Stage {
        let piece = match (behind, self.heads.last()) {
            (NONE, Some(&head)) => head,
            (NONE, None) => return Stage::Start(rest),
            (piece, _) => piece,
        };
        let node = self.end(piece);
        if self.free[node as usize] > 0 {
            self.walk = Some(Walk { first: NONE, last: NONE, node, behind: piece });
            return Stage::Insert(rest, piece);
        }
        match self.next[piece as usize] {
            NONE => Stage::Start(rest),
            next => Stage::Insert(rest, next),
        }
    }

    fn write_from(&self, trail: usize) -> Stage {
        self.heads.get(trail).map_or(Stage::Done, |&head| Stage::Write(trail, head))
    }

    /// Writes the points of a piece. Pieces that lead straight on become one, and a move ends a polyline.
    fn write(&mut self, trail: usize, piece: u32) -> Stage {
        let next = self.next[piece as usize];
        let own = self.pieces.get(piece as usize).copied();
        if let Some(Piece { layer, .. }) = own {
            let start = self.polylines.list.last().map_or(0, |&(_, end)| end);
            let [from, to] = [self.begin(piece), self.end(piece)].map(|node| self.nodes[node as usize].0);
            let points = &mut self.polylines.points;
            if points.len() == start {
                points.push(from);
            } else if points.len() - start >= 2 && goes_on([points[points.len() - 2], from, to]) {
                points.pop();
            }
            points.push(to);
            if next == NONE || next as usize >= self.pieces.len() {
                self.close(start, trail, layer);
            }
        }
        if next == NONE { self.write_from(trail + 1) } else { Stage::Write(trail, next) }
    }

    /// Ends a polyline that starts with the point `start`.
    fn close(&mut self, start: usize, trail: usize, layer: u32) {
        let Polylines { points, list, trails } = &mut self.polylines;
        let length: f64 = points[start..].windows(2).map(|pair| distance(pair[0], pair[1])).sum();
        if length < self.least || length == 0.0 {
            points.truncate(start);
        } else {
            list.push((layer, points.len()));
            trails.push(trail as u32);
        }
    }
}

/// Whether the way through three points is straight.
fn goes_on([a, b, c]: [Point; 3]) -> bool {
    let ([p, q], [r, s]) = ([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]);
    p * r + q * s > 0.0 && (p * s - q * r).abs() <= STRAIGHT * distance(a, b) * distance(b, c)
}
