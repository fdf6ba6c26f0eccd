// SPDX-License-Identifier: GPL-2.0-or-later
// Colours, numbers and small shapes that the pictures share.
'use strict';

// Okabe and Ito: safe for colour-blind readers; runs differ in shape and dashes as well.
const colours = ['#0072B2', '#D55E00', '#009E73', '#CC79A7', '#56B4E9', '#E69F00', '#000000'];
const dashes = [[], [8, 4], [2, 3], [8, 3, 2, 3], [12, 4], [4, 4], [1, 2]];
const shapes = ['circle', 'square', 'triangle', 'diamond', 'cross', 'ring', 'bar'];
const chosenColour = '#D55E00', eventColour = 'rgba(230, 159, 0, 0.30)', chosenShade = 'rgba(213, 94, 0, 0.20)';

// Slip velocity over the driving velocity, from 1 to 1000 on a logarithmic scale: lighter to darker
// throughout, so that it is read without colours as well.
const slipPalette = [[255, 255, 255], [255, 243, 196], [253, 200, 107], [243, 136, 60], [199, 68, 60], [122, 31, 99], [29, 11, 58]];

function shadeOf(velocity) {
  const decades = Math.log10(Math.abs(velocity)) / 3;
  return decades > 0 ? Math.min(255, Math.max(1, Math.round(255 * decades))) : 0;
}

function slipColour(shade) {
  const at = shade / 255 * (slipPalette.length - 1), k = Math.min(Math.floor(at), slipPalette.length - 2);
  return slipPalette[k].map((from, i) => Math.round(from + (at - k) * (slipPalette[k + 1][i] - from)));
}
const slipColours = Array.from({length: 256}, (_, shade) => slipColour(shade));

/** What events, sizes and times of a run are; earthquakes have the units of postproc's other commands. */
function unitsOf(run) {
  return run.info.model === 'seismicity'
    ? {events: 'earthquakes', size: '10^(1.5 M)', time: 'days since 1970', duration: 'days'}
    : {events: 'events (drops of PE)', size: 'model energy', time: 'model units', duration: 'time units'};
}

/** A number with so many significant digits, without zeros at its end. */
function short(x, digits = 5) {
  if (x === null || x === undefined || Number.isNaN(x)) return '–';
  if (x === 0 || !Number.isFinite(x)) return String(x);
  const size = Math.abs(x);
  if (size >= 1e7 || size < 1e-3) return x.toExponential(digits - 1).replace(/\.?0+e/, 'e').replace('e+', 'e').replace('-', '−').replace('e-', 'e−');
  return String(Number(x.toPrecision(digits))).replace('-', '−');
}

/** A number as one may type it. */
function plain(x) { return short(x, 6).replace(/−/g, '-'); }

/** Ticks of a logarithmic axis of dygraphs: powers of ten, each with a label as long as there is
 *  room; over less than two decades 2 and 5 as well. */
function logTicks(from, to, pixels, opts) {
  const first = Math.ceil(Math.log10(from) - 1e-9), last = Math.floor(Math.log10(to) + 1e-9);
  const every = Math.max(1, Math.ceil((last - first + 1) * opts('pixelsPerLabel') * 1.6 / pixels));
  const label = x => {
    const decade = Math.log10(x);
    return Math.abs(decade) < 2.5 ? String(Number(x.toPrecision(1))) : `${Number((x / 10 ** Math.floor(decade + 1e-9)).toPrecision(1))}e${Math.floor(decade + 1e-9)}`;
  };
  const out = [];
  for (let decade = first - 1; decade <= last; ++decade)
    for (const m of last - first < 2 ? [1, 2, 5] : [1]) {
      const v = m * 10 ** decade;
      if (v >= from && v <= to) out.push({v, label: m > 1 || (decade - first) % every === 0 ? label(v) : ''});
    }
  return out;
}

/** Round numbers between two others, some `count` of them. */
function ticks(from, to, count) {
  const raw = (to - from) / Math.max(1, count), power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find(m => m * power >= raw) * power;
  const out = [];
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to * (1 + 1e-12) + 1e-12; ++k) out.push(Number((k * step).toPrecision(12)));
  return out;
}

/** Makes a canvas as sharp as the screen; returns its context, to be drawn in CSS pixels. */
function sharp(canvas, width, height) {
  const ratio = window.devicePixelRatio || 1;
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext('2d');
  context.scale(ratio, ratio);
  context.font = '12px system-ui, sans-serif';
  return context;
}

/** Draws shades (a column of `rows` for each of `pixels`) into a frame; upright: the other way round. */
function drawShades(context, shades, pixels, rows, frame, upright) {
  const image = new ImageData(upright ? rows : pixels, upright ? pixels : rows);
  for (let p = 0; p < pixels; ++p)
    for (let r = 0; r < rows; ++r) {
      const at = 4 * (upright ? (pixels - 1 - p) * rows + r : (rows - 1 - r) * pixels + p);
      const [red, green, blue] = slipColours[shades[p * rows + r]];
      image.data[at] = red;
      image.data[at + 1] = green;
      image.data[at + 2] = blue;
      image.data[at + 3] = 255;
    }
  const own = document.createElement('canvas');
  own.width = image.width;
  own.height = image.height;
  own.getContext('2d').putImageData(image, 0, 0);
  context.imageSmoothingEnabled = false;
  context.drawImage(own, frame.x, frame.y, frame.w, frame.h);
}

/** Frame, round numbers and titles of a map. */
function drawAxes(context, frame, x, y) {
  context.strokeStyle = '#555';
  context.fillStyle = '#1a1a1a';
  context.lineWidth = 1;
  context.strokeRect(frame.x, frame.y, frame.w, frame.h);
  context.textBaseline = 'top';
  context.textAlign = 'center';
  if (x) {
    for (const value of ticks(x.from, x.to, frame.w / 80)) {
      const at = frame.x + (value - x.from) / (x.to - x.from) * frame.w;
      context.fillRect(at, frame.y + frame.h, 1, 4);
      if (at < frame.x + frame.w - 12) context.fillText(short(value), at, frame.y + frame.h + 6);
    }
    context.fillText(x.title, frame.x + frame.w / 2, frame.y + frame.h + 22);
  }
  context.textBaseline = 'middle';
  context.textAlign = 'right';
  for (const value of ticks(y.from, y.to, frame.h / 40)) {
    const at = frame.y + frame.h - (value - y.from) / (y.to - y.from) * frame.h;
    context.fillRect(frame.x - 4, at, 4, 1);
    context.fillText(short(value), frame.x - 6, at);
  }
  context.save();
  context.translate(12, frame.y + frame.h / 2);
  context.rotate(-Math.PI / 2);
  context.textAlign = 'center';
  context.fillText(y.title, 0, 0);
  context.restore();
}

/** Values in steps, filled down to 0, with axes; returns the largest value. */
function drawSteps(context, values, box, x, title) {
  const most = Math.max(...values) || 1, least = Math.min(0, ...values), n = values.length;
  const y = value => box.y + box.h - (value - least) / (1.05 * most - least) * box.h;
  context.beginPath();
  context.moveTo(box.x, y(0));
  values.forEach((value, k) => {
    context.lineTo(box.x + box.w * k / n, y(value));
    context.lineTo(box.x + box.w * (k + 1) / n, y(value));
  });
  context.lineTo(box.x + box.w, y(0));
  context.fillStyle = '#cfe3f1';
  context.fill();
  context.strokeStyle = '#0072B2';
  context.stroke();
  drawAxes(context, box, x, {from: least, to: 1.05 * most, title});
  return most;
}

/** The scale of slip velocities as a bar. */
function drawSlipScale(context, x, y, width) {
  for (let p = 0; p < width; ++p) {
    context.fillStyle = `rgb(${slipColours[Math.round(255 * p / (width - 1))].join()})`;
    context.fillRect(x + p, y, 1, 10);
  }
  context.strokeStyle = '#555';
  context.strokeRect(x, y, width, 10);
  context.fillStyle = '#1a1a1a';
  context.textBaseline = 'top';
  context.textAlign = 'center';
  [1, 10, 100, 1000].forEach((value, k) => context.fillText(String(value), x + width * k / 3, y + 13));
}

function drawLine(context, x0, y0, x1, y1) {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

/** A mark of a run's shape. */
function drawMark(context, shape, x, y, r) {
  context.beginPath();
  if (shape === 'square') context.rect(x - r, y - r, 2 * r, 2 * r);
  else if (shape === 'triangle') { context.moveTo(x, y - 1.2 * r); context.lineTo(x + 1.1 * r, y + r); context.lineTo(x - 1.1 * r, y + r); }
  else if (shape === 'diamond') { context.moveTo(x, y - 1.4 * r); context.lineTo(x + 1.4 * r, y); context.lineTo(x, y + 1.4 * r); context.lineTo(x - 1.4 * r, y); }
  else if (shape === 'cross') { context.rect(x - 1.3 * r, y - 0.4 * r, 2.6 * r, 0.8 * r); context.rect(x - 0.4 * r, y - 1.3 * r, 0.8 * r, 2.6 * r); }
  else if (shape === 'bar') context.rect(x - 0.4 * r, y - 1.3 * r, 0.8 * r, 2.6 * r);
  else context.arc(x, y, r, 0, 2 * Math.PI);
  context.closePath();
  if (shape === 'ring') context.stroke();
  else context.fill();
}

/** An element with text, never HTML: catalogues are shared between people. */
function element(name, text, attributes = {}) {
  const out = document.createElement(name);
  if (text !== undefined) out.textContent = text;
  for (const [key, value] of Object.entries(attributes)) out.setAttribute(key, value);
  return out;
}

/** Calls draw in the next frame, once however often it is asked for. */
function oncePerFrame(draw) {
  let waiting = false;
  return () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; draw(); });
  };
}
