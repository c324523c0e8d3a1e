// Writes a plant as SVG to standard output: node node.mjs > plant.svg
import { count, svg } from 'lsystem';

const plant = {
    axiom: 'X',
    rules: 'X -> F-[[X]+X]+F[+FX]-X\nF -> FF',
    angle: 22.5,
    heading: 65,
    iterations: 5,
    background: '#ffffff',
    palette: ['#1f5c3a'],
};
console.error(`${count(plant).symbols} symbols`);
console.log(svg(plant));
