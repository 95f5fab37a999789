/** Plots rate, distortion and speed of the codecs. */
import { PALETTE, type Panel, renderChart, type Series } from '../plot/chart.ts';
import type { CodecRow } from './measure.ts';

/** Where lossless results are drawn, dB. */
const LOSSLESS_DB = 60;

/** For each cloud: depth error and colour quality over bits per point, and time per frame. */
export function plotCodecs(rows: readonly CodecRow[]): string {
  const codecs = [...new Set(rows.map((row) => row.codec))];
  const clouds = [...new Set(rows.map((row) => row.cloud))];
  const panels = clouds.flatMap((cloud): Panel[] => {
    const own = rows.filter((row) => row.cloud === cloud);
    const series = (x: (row: CodecRow) => number, y: (row: CodecRow) => number): Series[] =>
      [...new Set(own.map((row) => row.codec))].map((codec) => {
        const points = own.filter((row) => row.codec === codec).sort((a, b) => x(a) - x(b));
        return {
          label: codec,
          x: points.map(x),
          y: points.map(y),
          shape: 'points',
          colour: PALETTE[codecs.indexOf(codec) % PALETTE.length] as string,
        };
      });
    const bits = (row: CodecRow) => row.bitsPerPoint;
    return [
      {
        title: cloud,
        xLabel: 'bits a point',
        yLabel: 'worst depth error (mm at 1 m, growing with z²)',
        series: series(bits, (row) => row.depthErrorMmPerZ2),
      },
      {
        title: `${cloud}: colour or intensity`,
        xLabel: 'bits a point',
        yLabel: 'PSNR (dB)',
        series: series(bits, (row) => Math.min(LOSSLESS_DB, row.colorPsnrDb ?? Number.NaN)),
      },
      {
        title: `${cloud}: speed`,
        xLabel: 'bits a point',
        yLabel: 'encode + decode (ms)',
        series: series(bits, (row) => row.encodeMs + row.decodeMs),
      },
    ];
  });
  return renderChart({
    title: 'Point codecs: rate, distortion and speed',
    subtitle: 'WASM, medians; 60 dB stands for no loss',
    panels,
    columns: 3,
  });
}
