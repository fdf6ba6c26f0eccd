// SPDX-License-Identifier: GPL-2.0-or-later
// Sizes and times of the events above a threshold that is dragged. Every number was found by the
// estimators of postproc when the page was made, for a grid of thresholds; nothing is fitted here.
'use strict';

/** Rows of a graph of customBars from curves [[x, low, value, high], ...], which need not share x. */
function mergedCurves(curves) {
  const rows = new Map();
  curves.forEach((curve, k) => {
    for (const [x, ...bar] of curve) {
      if (!rows.has(x)) rows.set(x, new Array(curves.length).fill(null));
      rows.get(x)[k] = bar;
    }
  });
  return [...rows.entries()].sort((a, b) => a[0] - b[0]).map(([x, bars]) => [x, ...bars]);
}

/** Smallest and largest x and y of the curves, with some room. */
function rangesOf(curves, logY, inY = []) {
  let [x0, x1, y0, y1] = [Infinity, -Infinity, Math.min(Infinity, ...inY), Math.max(-Infinity, ...inY)];
  for (const curve of curves)
    for (const [x, low, , high] of curve) {
      x0 = Math.min(x0, x);
      x1 = Math.max(x1, x);
      y0 = Math.min(y0, low);
      y1 = Math.max(y1, high);
    }
  if (!(x1 >= x0)) return {x: [0.1, 10], y: logY ? [0.1, 10] : [0, 1]};
  const room = logY ? 0 : 0.06 * Math.max(y1 - y0, 0.1);
  return {x: [x0 / 1.15, x1 * 1.15], y: logY ? [y0 / 1.5, y1 * 1.5] : [y0 - room, y1 + room]};
}

function drawThrough(context, points, k) {
  context.setLineDash(dashes[k % dashes.length]);
  context.beginPath();
  points.forEach((p, i) => { if (i) context.lineTo(p.canvasx, p.canvasy); else context.moveTo(p.canvasx, p.canvasy); });
  context.stroke();
  context.setLineDash([]);
}

/** Points with error bars, and behind them, where lined, a line. */
function markPlotter(k, lined) {
  return e => {
    const context = e.drawingContext;
    context.save();
    context.fillStyle = context.strokeStyle = colours[k % colours.length];
    if (lined) drawThrough(context, e.points, k);
    for (const p of e.points) {
      if (!Number.isFinite(p.canvasy)) continue;
      drawLine(context, p.canvasx, e.dygraph.toDomYCoord(p.yval_minus), p.canvasx, e.dygraph.toDomYCoord(p.yval_plus));
      drawMark(context, shapes[k % shapes.length], p.canvasx, p.canvasy, 3);
    }
    context.restore();
  };
}

function linePlotter(k) {
  return e => {
    const context = e.drawingContext;
    context.save();
    context.strokeStyle = colours[k % colours.length];
    context.lineWidth = 2;
    drawThrough(context, e.points, k);
    context.restore();
  };
}

class Statistics {
  constructor(app) {
    this.app = app;
    this.find = id => document.getElementById(id);
    this.graphs = {};
    this.dragged = new Map();  // the graph of each element in which the threshold is dragged
    this.slider = this.find('threshold');
    this.slider.addEventListener('input', () => app.setThreshold(this.sizes[Number(this.slider.value)]));
    this.find('usual-threshold').addEventListener('click', () => app.setThreshold(this.usual()));
  }

  /** The catalogues that are compared: those of the kind chosen. */
  showKind() {
    this.entries = this.app.runs.map((run, k) => ({run, k, events: this.app.eventsOf(run)}))
      .filter(entry => entry.events.info.kind === this.app.kind);
    this.sizes = [...new Set(this.entries.flatMap(entry => entry.events.info.thresholds.map(t => t.size)))].sort((a, b) => a - b);
    this.slider.min = 0;
    this.slider.max = Math.max(0, this.sizes.length - 1);
    document.getElementById('statistics-head').parentElement.classList.toggle('empty', this.sizes.length === 0);
    for (const id of ['threshold', 'usual-threshold']) this.find(id).disabled = this.sizes.length === 0;
    if (this.sizes.length === 0) this.find('threshold-hint').textContent = 'Too few events for statistics.';
    else this.find('usual-text').textContent = this.entries.reduce((a, b) => b.events.info.usual > a.events.info.usual ? b : a).events.info.usualText;
    this.app.threshold = this.usual();
    this.makeGraphs();
    this.draw();
  }

  /** The threshold that the commands use where none is given, if there is one with enough events. */
  usual() {
    const wanted = Math.max(...this.entries.map(entry => entry.events.info.usual));
    return this.sizes.length === 0 ? wanted : this.nearest(this.sizes, wanted);
  }

  nearest(sizes, wanted) {
    return sizes.reduce((best, x) => Math.abs(Math.log(x / wanted)) < Math.abs(Math.log(best / wanted)) ? x : best, sizes[0]);
  }

  /** What was found for a catalogue at the threshold; null if that is above its grid. */
  at(entry) {
    return entry.events.info.thresholds.find(t => t.size === this.app.threshold) || null;
  }

  gammaOf(result) { return result.gammas.find(g => g.deltaHeld && g.method === 'maximum likelihood'); }

  printed(name) {
    const values = {exponent: {lsm: 1.07, 'block-slider': 1.0}, gamma: {lsm: 0.995, 'block-slider': 0.0}};
    return [...new Set(this.entries.map(entry => values[name][entry.run.info.model]))].filter(Number.isFinite);
  }

  sizeLabel() { return `size (${[...new Set(this.entries.map(entry => unitsOf(entry.run).size))].join(', ')})`; }

  curveOf(entry, numberOf) {
    return entry.events.info.thresholds.map(t => [t.size, numberOf(t)]).filter(([, number]) => number && Number.isFinite(number.value))
      .map(([x, {value, error}]) => [x, value - (error || 0), value, value + (error || 0)]);
  }

  makeGraphs() {
    const curves = (numberOf) => this.entries.map(entry => this.curveOf(entry, numberOf));
    this.againstThreshold('exponents', 'exponent', curves(t => t.law), this.printed('exponent'));
    this.againstThreshold('gammas', 'γ', curves(t => this.gammaOf(t)), this.printed('gamma'));
    this.againstThreshold('burstiness', 'burstiness', curves(t => ({value: t.burstiness, error: 0})), [0]);
    const densities = this.entries.map(entry => entry.events.info.densities.map(Statistics.barOfBin));
    this.sizeCurves = densities;
    this.sizeRanges = rangesOf(densities, true);
    this.logGraph('sizes', this.sizeLabel(), 'density', this.sizeRanges, true);
    this.logGraph('times', 'time between events', 'density', {x: [0.1, 10], y: [0.1, 10]}, false);
  }

  static barOfBin([lo, hi, density, error]) {
    return [Math.sqrt(lo * hi), Math.max(density - error, density / 10), density, density + error];
  }

  options(xlabel, ylabel, ranges) {
    return {
      legend: 'never', customBars: true, connectSeparatedPoints: true, interactionModel: {}, highlightCircleSize: 0,
      gridLineColor: '#e2e2e2', axisLineColor: '#555', xlabel, ylabel, dateWindow: ranges.x, valueRange: ranges.y
    };
  }

  againstThreshold(id, name, curves, printed) {
    const ranges = rangesOf(curves, false, printed);
    const first = Math.min(...this.sizes, 1), last = Math.max(...this.sizes, first * 10);
    ranges.x = [first / 1.2, last * 1.2];
    const names = this.entries.map(entry => `run ${entry.k}`);
    const graph = this.replace(id, this.rowsOf(curves, ranges), {
      ...this.options(`smallest ${this.sizeLabel()}`, name, ranges),
      labels: ['size', ...names],
      series: Object.fromEntries(this.entries.map((entry, i) => [names[i], {plotter: markPlotter(entry.k, true)}])),
      axes: {x: {logscale: true, ticker: logTicks, pixelsPerLabel: 26}, y: {axisLabelWidth: 46}},
      underlayCallback: (context, area, g) => {
        context.save();
        context.strokeStyle = '#555';
        context.setLineDash([2, 4]);
        for (const value of printed) {
          const y = g.toDomYCoord(value);
          drawLine(context, area.x, y, area.x + area.w, y);
        }
        context.restore();
        this.drawHandle(context, area, g);
      }
    });
    this.dragOn(id, graph);
  }

  logGraph(id, xlabel, ylabel, ranges, withThreshold) {
    const names = this.entries.flatMap(entry => [`run ${entry.k}`, `line ${entry.k}`]);
    const series = {};
    for (const entry of this.entries) {
      series[`run ${entry.k}`] = {plotter: markPlotter(entry.k, false)};
      series[`line ${entry.k}`] = {plotter: linePlotter(entry.k)};
    }
    const axis = {logscale: true, ticker: logTicks, pixelsPerLabel: 26};
    const graph = this.replace(id, this.rowsOf(names.map(() => []), ranges), {
      ...this.options(xlabel, ylabel, ranges), labels: ['x', ...names], series,
      logscale: true, axes: {x: axis, y: {...axis, pixelsPerLabel: 14, axisLabelWidth: 46}},
      underlayCallback: (context, area, g) => { if (withThreshold) this.drawHandle(context, area, g); }
    });
    if (withThreshold) this.dragOn(id, graph);
  }

  /** A graph without a row shows a message; one row at each end does no harm. */
  rowsOf(curves, ranges) {
    const rows = mergedCurves(curves), none = curves.map(() => null);
    return [[ranges.x[0], ...none], ...rows, [ranges.x[1], ...none]].filter((row, i, all) => i === 0 || row[0] > all[i - 1][0]);
  }

  /** A graph in the place of the one that is there: going, it takes along what is in its element. */
  replace(id, rows, options) {
    if (this.graphs[id]) this.graphs[id].destroy();
    this.graphs[id] = new Dygraph(this.find(id), rows, options);
    return this.graphs[id];
  }

  /** Where a size is in a graph whose x axis is logarithmic (toDomXCoord takes it for a linear one). */
  static xOf(graph, size) {
    const area = graph.getArea();
    return area.x + graph.toPercentXCoord(size) * area.w;
  }

  /** The line that is dragged; grey: smaller than what the commands use. */
  drawHandle(context, area, graph) {
    const clip = x => Math.min(Math.max(x, area.x), area.x + area.w);
    context.save();
    context.fillStyle = 'rgba(0, 0, 0, 0.07)';
    const usual = Math.max(...this.entries.map(entry => entry.events.info.usual));
    context.fillRect(area.x, area.y, clip(Statistics.xOf(graph, usual)) - area.x, area.h);
    const x = clip(Statistics.xOf(graph, this.app.threshold));
    context.strokeStyle = context.fillStyle = chosenColour;
    context.lineWidth = 2;
    drawLine(context, x, area.y, x, area.y + area.h);
    context.beginPath();
    context.moveTo(x - 7, area.y);
    context.lineTo(x + 7, area.y);
    context.lineTo(x, area.y + 10);
    context.fill();
    context.restore();
  }

  dragOn(id, graph) {
    const box = this.find(id);
    const known = this.dragged.has(id);
    this.dragged.set(id, graph);
    if (known) return;
    const move = event => {
      if (!(event.buttons & 1) || this.sizes.length === 0) return;
      const left = box.getBoundingClientRect().left;
      this.app.setThreshold(this.nearest(this.sizes, this.dragged.get(id).toDataXCoord(event.clientX - left)));
      event.preventDefault();
    };
    box.addEventListener('pointerdown', event => { box.setPointerCapture(event.pointerId); move(event); });
    box.addEventListener('pointermove', move);
  }

  draw() {
    const size = this.app.threshold, index = this.sizes.indexOf(size);
    this.slider.value = String(index);
    this.slider.setAttribute('aria-valuetext', `size ${plain(size)}`);
    this.find('threshold-size').textContent = short(size);
    this.drawTable();
    this.drawCurves();
    for (const name of ['exponents', 'gammas', 'burstiness']) this.graphs[name].updateOptions({});
  }

  drawCurves() {
    const sizes = this.entries.map((entry, i) => [this.sizeCurves[i], this.fittedSizes(entry)]);
    this.graphs.sizes.updateOptions({file: this.rowsOf(sizes.flat(), this.sizeRanges)});
    const times = this.entries.map(entry => {
      const result = this.at(entry);
      return result ? [result.bins.map(Statistics.barOfBin), this.fittedTimes(result)] : [[], []];
    });
    const ranges = rangesOf(times.map(pair => pair[0]), true);
    this.graphs.times.updateOptions({file: this.rowsOf(times.flat(), ranges), dateWindow: ranges.x, valueRange: ranges.y});
  }

  /** The law over three decades from the threshold on, through the density of the whole catalogue. */
  fittedSizes(entry) {
    const result = this.at(entry), law = result && result.law;
    if (!law || !Number.isFinite(law.value)) return [];
    const total = entry.events.info.densities.reduce((sum, bin) => sum + bin[4], 0), alpha = law.value;
    const integral = Math.abs(alpha - 1) < 1e-9 ? Math.log(law.hi / law.lo) : (law.hi ** (1 - alpha) - law.lo ** (1 - alpha)) / (1 - alpha);
    const at = x => law.n / total * x ** -alpha / integral;
    return [law.lo, law.hi].map(x => [x, at(x), at(x), at(x)]);
  }

  fittedTimes(result) {
    const law = this.gammaOf(result);
    if (!law || !Number.isFinite(law.value) || result.bins.length === 0) return [];
    const from = result.bins[0][0], to = result.bins[result.bins.length - 1][1], curve = [];
    const least = Math.min(...result.bins.map(bin => bin[2])) / 3;
    for (let k = 0; k <= 80; ++k) {
      const theta = from * (to / from) ** (k / 80);
      const value = law.C * theta ** (law.value - 1) * Math.exp(-(theta ** law.delta) / law.B);
      if (value >= least) curve.push([theta, value, value, value]);
    }
    return curve;
  }

  drawTable() {
    const heads = ['Run', 'Events', 'Mean time between them', 'Exponent of the sizes, three decades',
      'γ (δ = 1, likelihood)', 'γ (δ = 1, least squares)', 'γ (δ free, likelihood)', 'Deviation / mean', 'Burstiness'];
    const head = element('tr');
    head.append(...heads.map(text => element('th', text, {scope: 'col'})));
    this.find('statistics').tHead.replaceChildren(head);
    const cell = (number, name, more = '') => {
      const text = number ? number.text || '–' : '–';
      return element('td', text + (number && number.text ? more : ''), {'data-name': name, ...(number && number.why ? {title: `Not determined: ${number.why}`} : {})});
    };
    this.find('statistics').tBodies[0].replaceChildren(...this.entries.map(entry => {
      const row = element('tr'), result = this.at(entry), name = element('th', undefined, {scope: 'row'});
      const mark = element('canvas');
      const context = sharp(mark, 14, 12);
      context.fillStyle = context.strokeStyle = colours[entry.k % colours.length];
      drawMark(context, shapes[entry.k % shapes.length], 6, 6, 4);
      name.append(mark, entry.run.info.label);
      row.append(name);
      if (!result) {
        const sizes = entry.events.info.thresholds.map(t => t.size);
        const why = this.app.threshold > Math.max(...sizes) ? 'too few events of this size' : 'no events as small as this';
        row.append(element('td', why, {colspan: String(heads.length - 1)}));
        return row;
      }
      const gamma = (held, method) => result.gammas.find(g => g.deltaHeld === held && g.method === method);
      const {law} = result;
      row.append(
        element('td', String(result.times + 1), {'data-name': 'events'}),
        element('td', result.meanText, {'data-name': 'mean'}),
        cell(law, 'exponent', law.text ? ` (${short(law.lo, 3)} to ${short(law.hi, 3)}, ${law.n} events)` : ''),
        cell(gamma(true, 'maximum likelihood'), 'gamma'),
        cell(gamma(true, 'least squares'), 'gamma-least-squares'),
        cell(gamma(false, 'maximum likelihood'), 'gamma-free'),
        element('td', result.variationText, {'data-name': 'variation'}),
        element('td', result.burstinessText, {'data-name': 'burstiness'}));
      return row;
    }));
    const size = plain(this.app.threshold);
    this.find('commands').textContent = this.entries.flatMap(entry => {
      const file = `'${entry.events.info.file.replace(/'/g, "'\\''")}'`;
      return [`postproc fit ${file} --threshold ${size} -o sizes`,
        `postproc intervals ${file} --threshold ${size} -o times`];
    }).join('\n');
  }
}
