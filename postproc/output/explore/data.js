// SPDX-License-Identifier: GPL-2.0-or-later
// Content of the page: a JSON element for small data; long columns are packed in elements of
// their own (output/packed_numbers.h): bytes, compressed by zlib, in base 64.
'use strict';

async function unpacked(id) {
  const letters = atob(document.getElementById(id).textContent);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = letters.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  document.getElementById(id).remove();
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Numbers whose first bytes come first, then their second bytes, and so on. */
async function unpackedNumbers(id, Kind) {
  const bytes = await unpacked(id), width = Kind.BYTES_PER_ELEMENT, n = bytes.length / width;
  const out = new Uint8Array(bytes.length);
  for (let k = 0; k < width; ++k)
    for (let i = 0; i < n; ++i) out[width * i + k] = bytes[n * k + i];
  return new Kind(out.buffer);
}

/** Index of the first element that is not below x, of an ascending list. */
function lowerBound(list, x, length = list.length) {
  let from = 0, to = length;
  while (from < to) {
    const middle = (from + to) >> 1;
    if (list[middle] < x) from = middle + 1;
    else to = middle;
  }
  return from;
}

/** A series of PE with the smallest and largest of each 16, 64, 256, ... samples, so that no drop is
 *  lost however many samples share a pixel. */
class Series {
  static group = 16;
  static factor = 4;

  static async load(info) {
    const series = new Series();
    series.info = info;
    const codes = new Int8Array((await unpacked(info.bytes)).buffer);
    const values = new Float64Array(info.kept);
    values[0] = info.first;
    values[1] = info.second;
    // The sums are those of the program to the last bit: the same operations in the same order.
    let before = info.first, now = info.second;
    for (let i = 0; i < codes.length; ++i) {
      const code = codes[i], predicted = 2 * now - before;
      before = now;
      now = code < 0 ? predicted - info.off[-code] : predicted + info.off[code];
      values[i + 2] = now;
    }
    series.values = values;
    series.times = null;
    if (info.gaps) {
      const gaps = await unpackedNumbers(info.gaps, Float32Array);
      series.times = new Float64Array(info.kept);
      series.times[0] = info.begin;
      for (let i = 0; i < gaps.length; ++i) series.times[i + 1] = series.times[i] + gaps[i];
    }
    series.buildPyramid();
    return series;
  }

  buildPyramid() {
    this.levels = [];
    let low = this.values, high = this.values, factor = Series.group;
    while (low.length > 64) {
      const n = Math.ceil(low.length / factor);
      const nextLow = new Float64Array(n), nextHigh = new Float64Array(n);
      for (let g = 0; g < n; ++g) {
        const end = Math.min((g + 1) * factor, low.length);
        let least = Infinity, most = -Infinity;
        for (let i = g * factor; i < end; ++i) {
          if (low[i] < least) least = low[i];
          if (high[i] > most) most = high[i];
        }
        nextLow[g] = least;
        nextHigh[g] = most;
      }
      this.levels.push({low: nextLow, high: nextHigh});
      low = nextLow;
      high = nextHigh;
      factor = Series.factor;
    }
  }

  get length() { return this.values.length; }
  get begin() { return this.time(0); }
  get end() { return this.time(this.length - 1); }
  time(i) { return this.times ? this.times[i] : this.info.begin + i * this.info.spacing; }

  /** Index of the first sample that is not before a time. */
  index(time) {
    if (this.times) return lowerBound(this.times, time);
    const i = Math.ceil((time - this.info.begin) / this.info.spacing - 1e-6);
    return Math.min(Math.max(i, 0), this.length);
  }

  /** Step of a sample, or null where samples were joined. */
  step(i) {
    return this.info.kept === this.info.samples ? this.info.firstStep + i * this.info.stride : null;
  }

  /** Smallest and largest value of the samples from one index up to, not including, another. */
  extremes(from, to) {
    let least = Infinity, most = -Infinity;
    const look = (low, high, first, last) => {
      for (let i = first; i < last; ++i) {
        if (low[i] < least) least = low[i];
        if (high[i] > most) most = high[i];
      }
    };
    // Whole groups from the widest level that fits, what is over at both ends from those below it.
    const within = (level, first, last) => {
      const [low, high] = level < 0 ? [this.values, this.values] : [this.levels[level].low, this.levels[level].high];
      const factor = level < 0 ? Series.group : Series.factor;
      const up = Math.ceil(first / factor), down = Math.floor(last / factor);
      if (level + 1 >= this.levels.length || up >= down) {
        look(low, high, first, last);
        return;
      }
      look(low, high, first, up * factor);
      look(low, high, down * factor, last);
      within(level + 1, up, down);
    };
    within(-1, Math.max(0, from), Math.min(this.length, to));
    return [least, most];
  }

  /** Points [time, PE] that show the series between two times in a picture so many pixels wide: each
   *  sample, or the smallest and the largest of each half pixel. */
  points(from, to, pixels) {
    const first = Math.max(0, this.index(from) - 1), last = Math.min(this.length, this.index(to) + 1);
    const out = [];
    if (last - first <= 4 * pixels) {
      for (let i = first; i < last; ++i) out.push([this.time(i), this.values[i]]);
      return out;
    }
    const columns = 2 * pixels;
    for (let c = 0; c < columns; ++c) {
      // By time, not by samples: where a run leaps, samples are not equally spaced.
      const begin = c === 0 ? first : this.index(from + (to - from) * c / columns);
      const end = c === columns - 1 ? last : this.index(from + (to - from) * (c + 1) / columns);
      if (end <= begin) continue;
      const [low, high] = this.extremes(begin, end);
      const falls = this.values[end - 1] < this.values[begin];
      out.push([this.time(begin), falls ? high : low]);
      if (end - begin > 1) out.push([this.time(end - 1), falls ? low : high]);
    }
    return out;
  }
}

/** The events of one kind of a run, by column. */
class Events {
  static async load(info) {
    const events = new Events();
    events.info = info;
    const numbers = await unpackedNumbers(info.numbers, Float64Array), n = info.listed;
    events.columns = {};
    info.columns.forEach((name, k) => { events.columns[name] = numbers.subarray(k * n, (k + 1) * n); });
    events.longest = 0;
    for (let i = 0; i < n; ++i)
      events.longest = Math.max(events.longest, events.columns.t_end[i] - events.columns.t_start[i]);
    events.bySize = Uint32Array.from({length: n}, (_, i) => i);
    const size = events.columns.size;
    events.bySize.sort((a, b) => size[b] - size[a] || a - b);
    return events;
  }

  get length() { return this.info.listed; }
  has(name) { return name in this.columns; }
  get(name, i) { return name === 'duration' ? this.columns.t_end[i] - this.columns.t_start[i] : this.columns[name][i]; }
  /** Where an event is along the fault, for sorting and filtering. */
  get place() { return this.has('x_centroid') ? 'x_centroid' : null; }

  /** Indices of the events that overlap with some time. */
  between(from, to) {
    const start = this.columns.t_start, end = this.columns.t_end, out = [];
    for (let i = lowerBound(start, from - this.longest); i < this.length && start[i] <= to; ++i)
      if (end[i] >= from) out.push(i);
    return out;
  }
}

/** Slip velocity of the fault in space and time (statistics/slip_image.h). */
class Slip {
  static async load(info) {
    const slip = new Slip();
    slip.info = info;
    slip.ends = await unpackedNumbers(info.ends, Float64Array);
    slip.cells = new Int8Array((await unpacked(info.cells)).buffer);
    slip.columns = info.columns;
    // Colour of each byte, by the logarithm of the velocity, whatever its sign.
    slip.shades = Uint8Array.from({length: 256}, (_, byte) => shadeOf(slip.velocity(byte > 127 ? byte - 256 : byte)));
    return slip;
  }

  /** Over the driving velocity; negative: backwards. */
  velocity(byte) { return byte < 0 ? -this.info.velocity[-byte] : this.info.velocity[byte]; }
  rowBegin(row) { return row === 0 ? this.info.begin : this.ends[row - 1]; }
  /** The row that holds a time; -1 or the number of rows outside. */
  rowAt(time) {
    if (time < this.info.begin) return -1;
    const row = lowerBound(this.ends, time);
    return row < this.ends.length && this.ends[row] === time ? row + 1 : row;
  }
  columnAt(place) {
    const along = ((place - this.info.x0) % this.info.length + this.info.length) % this.info.length;
    return Math.min(this.columns - 1, Math.floor(along / this.info.columnWidth));
  }
  /** What the mouse points at in a picture of an element: parts of its width and height, and the slip
   *  velocity at the time and place that they stand for; null outside. */
  under(event, frame, timeAndPlace) {
    const box = event.currentTarget.getBoundingClientRect();
    const u = (event.clientX - box.left - frame.x) / frame.w, v = 1 - (event.clientY - box.top - frame.y) / frame.h;
    const {time, x, place = x} = timeAndPlace(u, v), row = this.rowAt(time);
    if (u < 0 || u > 1 || v < 0 || v > 1 || row < 0 || row >= this.ends.length) return null;
    return {time, x, velocity: short(this.velocity(this.cells[row * this.columns + this.columnAt(place)]), 3)};
  }

  /** Slip of each column between two times, by the rows that begin and end within. */
  slipBetween(from, to) {
    const out = new Float64Array(this.columns);
    const tolerance = 1e-9 * Math.max(1, Math.abs(to));
    for (let row = Math.max(0, this.rowAt(from - tolerance)); row < this.ends.length; ++row) {
      if (this.rowBegin(row) < from - tolerance) continue;
      if (this.ends[row] > to + tolerance) break;
      const unit = (this.ends[row] - this.rowBegin(row)) * this.info.driving;
      for (let c = 0; c < this.columns; ++c) out[c] += this.velocity(this.cells[row * this.columns + c]) * unit;
    }
    return out;
  }

  /** Shades of a picture so many pixels wide over time, a column for each place: the fastest slip in
   *  each pixel. */
  shadesOver(from, to, pixels) {
    const shades = new Uint8Array(pixels * this.columns), n = this.columns;
    const scale = pixels / (to - from);
    for (let row = Math.max(0, this.rowAt(from)); row < this.ends.length; ++row) {
      const begin = this.rowBegin(row);
      if (begin >= to) break;
      const first = Math.max(0, Math.floor((begin - from) * scale));
      const last = Math.min(pixels - 1, Math.ceil((this.ends[row] - from) * scale) - 1);
      for (let c = 0; c < n; ++c) {
        const shade = this.shades[this.cells[row * n + c] & 255];
        if (shade === 0) continue;
        for (let p = first; p <= last; ++p)
          if (shades[p * n + c] < shade) shades[p * n + c] = shade;
      }
    }
    return shades;
  }
}

async function loadRun(info) {
  return {
    info,
    kinds: await Promise.all(info.kinds.map(Events.load)),
    series: info.series ? await Series.load(info.series) : null,
    slip: info.history ? await Slip.load(info.history) : null
  };
}
