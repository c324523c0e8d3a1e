//! Pieces joined end to end into as few polylines as possible.
//!
//! The ends of the pieces are the nodes of a graph. A polyline is a trail in this graph: it takes every piece once.
//! A connected part with 2k nodes of odd degree needs k trails, or one if there are none (Euler 1736). The nodes of odd
//! degree are joined in pairs by moves of the raised pen, with little travel in all. Then the graph has closed trails
//! (Hierholzer 1873); the moves part them into polylines, and the order along a closed trail has no other travel.
//!
//! A move of at most a pen's width is drawn: the round ends of two lines touch there, and to raise the pen takes longer.
//! So is a move of a few pens that leads over ink. All these moves together are no longer than the ink that the cut saved.
//! Between visible lines, moves are drawn only as far as their ink is that of the round ends.

use crate::cells::Cells;
use crate::hide::touching;
use crate::ink::Ink;
use crate::merge::{JOINT, Piece};
use crate::options::PlotOptions;
use crate::page::{Point, distance};
use crate::pair::pairs;
use crate::spots::Spots;
use lsystem_syntax::{Halt, Work};

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
pub(crate) struct Polylines {
    pub(crate) points: Vec<Point>,
    /// The layer and the end of each polyline in `points`; it starts where the one before ends.
    pub(crate) list: Vec<(u32, usize)>,
    /// By polyline: the number of its closed trail. The polylines of a closed trail follow each other.
    pub(crate) trails: Vec<u32>,
}

impl Polylines {
    pub(crate) fn layer(&self, number: usize) -> u32 {
        self.list[number].0
    }

    pub(crate) fn points_of(&self, number: usize) -> &[Point] {
        let start = if number == 0 { 0 } else { self.list[number - 1].1 };
        &self.points[start..self.list[number].1]
    }

    /// The first and the last point.
    pub(crate) fn ends(&self, number: usize) -> [Point; 2] {
        let points = self.points_of(number);
        [points[0], points[points.len() - 1]]
    }

    /// The place in `points` at which the last polyline starts that has not ended.
    fn start(&self) -> usize {
        self.list.last().map_or(0, |&(_, end)| end)
    }

    /// Goes along a line.
    fn go(&mut self, [from, to]: [Point; 2]) {
        let start = self.start();
        let points = &mut self.points;
        if points.len() == start {
            points.push(from);
        } else if points.len() - start >= 2 && goes_on([points[points.len() - 2], from, to]) {
            points.pop();
        }
        points.push(to);
    }

    /// Ends a polyline, or leaves it out if it is shorter than `least`.
    fn end(&mut self, layer: u32, trail: u32, least: f64) {
        let start = self.start();
        let length: f64 = self.points[start..].windows(2).map(|pair| distance(pair[0], pair[1])).sum();
        if length < least || length == 0.0 {
            self.points.truncate(start);
        } else {
            self.list.push((layer, self.points.len()));
            self.trails.push(trail);
        }
    }

    pub(crate) fn is_closed(&self, number: usize) -> bool {
        let [start, end] = self.ends(number);
        start == end
    }
}

/// Joins ink.
pub(crate) fn join(ink: Ink, options: &PlotOptions, work: &mut dyn Work) -> Result<Polylines, Halt> {
    let longest = options.pen * if options.hide { touching() } else { 1.0 };
    let mut join = Join { pieces: ink.pieces, spots: ink.spots, spare: ink.spare, longest, ..Join::default() };
    join.pen = options.pen;
    join.number(work)?;
    join.pair(work)?;
    join.list(work)?;
    // Moves come first, so that a trail with moves starts with one.
    for piece in (0..join.ends.len() as u32).rev() {
        work.charge(2)?;
        if !join.taken[piece as usize] {
            join.add_trail(piece, work)?;
        }
    }
    join.write(options.least, work)
}

/// The graph of pieces and moves.
#[derive(Default)]
struct Join {
    pieces: Vec<Piece>,
    pen: f64,
    /// The longest move that is drawn wherever it leads, in millimetres.
    longest: f64,
    spots: Spots,
    /// The length of the moves that may still be drawn.
    spare: f64,
    /// The nodes of the moves so far.
    moves: Vec<[u32; 2]>,
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
}

impl Join {
    /// Numbers the ends of the pieces.
    fn number(&mut self, work: &mut dyn Work) -> Result<(), Halt> {
        let mut cells = Cells::new([JOINT; 2]);
        for &Piece { layer, ends } in &self.pieces {
            work.charge(2)?;
            let nodes = ends.map(|end| {
                let (node, is_new) = cells.number(layer, end);
                if is_new {
                    self.nodes.push((end, layer));
                    self.free.push(0);
                }
                self.free[node as usize] += 1;
                node
            });
            self.ends.push(nodes);
        }
        Ok(())
    }

    /// Joins the nodes of odd degree in pairs, layer by layer.
    fn pair(&mut self, work: &mut dyn Work) -> Result<(), Halt> {
        let mut odd: Vec<Vec<u32>> = Vec::new();
        for (node, &(_, layer)) in (0..).zip(&self.nodes) {
            work.charge(2)?;
            if self.free[node as usize] % 2 == 1 {
                odd.resize(odd.len().max(layer as usize + 1), Vec::new());
                odd[layer as usize].push(node);
            }
        }
        for nodes in odd {
            let points: Vec<Point> = nodes.iter().map(|&node| self.nodes[node as usize].0).collect();
            for [a, b] in pairs(&points, work)? {
                let ends = [nodes[a as usize], nodes[b as usize]];
                ends.iter().for_each(|&node| self.free[node as usize] += 1);
                self.add_move(ends);
            }
        }
        Ok(())
    }

    /// Adds a move between two nodes, or a piece if the move is short and ink is spare.
    fn add_move(&mut self, nodes: [u32; 2]) {
        let [(from, layer), (to, _)] = nodes.map(|node| self.nodes[node as usize]);
        let length = distance(from, to);
        let is_over_ink = || length <= OVER_INK * self.pen && self.spots.has(layer, [from, to]);
        if length <= self.spare && (length <= self.longest || is_over_ink()) {
            self.spare -= length;
            self.pieces.push(Piece { layer, ends: [from, to] });
            self.ends.push(nodes);
        } else {
            self.moves.push(nodes);
        }
    }

    /// Lists the pieces and moves at each node.
    fn list(&mut self, work: &mut dyn Work) -> Result<(), Halt> {
        self.ends.append(&mut self.moves);
        let count = self.ends.len();
        self.taken = vec![false; count];
        self.flipped = vec![false; count];
        self.next = vec![NONE; count];
        self.around = vec![0; 2 * count];
        let mut start = 0;
        for free in &self.free {
            work.charge(2)?;
            self.starts.push(start);
            start += free;
        }
        self.limits.clone_from(&self.starts);
        for (piece, &ends) in (0..).zip(&self.ends) {
            work.charge(2)?;
            for node in ends {
                let limit = &mut self.limits[node as usize];
                self.around[*limit as usize] = piece;
                *limit += 1;
            }
        }
        Ok(())
    }

    /// Adds a closed trail that starts with a piece or move, and inserts trails into it until no piece at its nodes is
    /// free.
    fn add_trail(&mut self, head: u32, work: &mut dyn Work) -> Result<(), Halt> {
        self.put(head, self.ends[head as usize][0]);
        self.walk(self.end(head), head, work)?;
        self.heads.push(head);
        let mut piece = head;
        while piece != NONE {
            work.charge(2)?;
            let node = self.end(piece);
            if self.free[node as usize] == 0 {
                piece = self.next[piece as usize];
            } else if let Some([first, last]) = self.walk(node, NONE, work)? {
                self.next[last as usize] = self.next[piece as usize];
                self.next[piece as usize] = first;
            }
        }
        Ok(())
    }

    /// Notes that a piece is in a trail, which enters it at a node.
    fn put(&mut self, piece: u32, node: u32) {
        self.taken[piece as usize] = true;
        self.flipped[piece as usize] = self.ends[piece as usize][0] != node;
        self.ends[piece as usize].iter().for_each(|&end| self.free[end as usize] -= 1);
    }

    /// Takes free pieces from a node on, each from the end of the one before, until there is none. The first one follows
    /// `last`. Returns the first piece and the last one.
    fn walk(&mut self, mut node: u32, mut last: u32, work: &mut dyn Work) -> Result<Option<[u32; 2]>, Halt> {
        let mut first = None;
        while let Some(piece) = self.take(node, last, work)? {
            work.charge(2)?;
            if last != NONE {
                self.next[last as usize] = piece;
            }
            first = first.or(Some(piece));
            last = piece;
            node = self.end(piece);
        }
        Ok(first.map(|first| [first, last]))
    }

    /// Takes a free piece at a node: the one that leads most straight on from `last`, or else a move.
    fn take(&mut self, node: u32, last: u32, work: &mut dyn Work) -> Result<Option<u32>, Halt> {
        let at = node as usize;
        let from = if last == NONE { None } else { self.way_from(last, self.begin(last)) };
        let (mut best, mut best_turn) = (None, f64::INFINITY);
        let (mut slot, mut compared) = (self.starts[at] as usize, 0);
        while slot < self.limits[at] as usize && compared < COMPARED {
            work.charge(1)?;
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
        if let Some(piece) = best {
            self.put(piece, node);
        }
        Ok(best)
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

    /// The points of all trails. Pieces that lead straight on become one, and a move ends a polyline. Polylines that are
    /// shorter than `least` are left out.
    fn write(&self, least: f64, work: &mut dyn Work) -> Result<Polylines, Halt> {
        let mut polylines = Polylines::default();
        for (trail, &head) in (0..).zip(&self.heads) {
            let mut piece = head;
            while piece != NONE {
                work.charge(2)?;
                let next = self.next[piece as usize];
                if let Some(&Piece { layer, .. }) = self.pieces.get(piece as usize) {
                    polylines.go([self.begin(piece), self.end(piece)].map(|node| self.nodes[node as usize].0));
                    if next == NONE || next as usize >= self.pieces.len() {
                        polylines.end(layer, trail, least);
                    }
                }
                piece = next;
            }
        }
        Ok(polylines)
    }
}

/// Whether the way through three points is straight.
fn goes_on([a, b, c]: [Point; 3]) -> bool {
    let ([p, q], [r, s]) = ([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]);
    p * r + q * s > 0.0 && (p * s - q * r).abs() <= STRAIGHT * distance(a, b) * distance(b, c)
}
