/**
 * The report of a session as one printable page: a file of its own, without scripts and without anything that is fetched. Names come
 * from robots and people, so every text is escaped, and a policy in the page forbids scripts as well. Pure.
 */
import type { Summary } from '../ground/report/quantiles.ts';
import type { SessionReport } from '../ground/report/report-schema.ts';
import { laterTexts } from './language.ts';
import { durationText } from './session-text.ts';

const STYLE = `body{font:14px/1.4 system-ui,sans-serif;color:#111;background:#fff;max-width:52rem;margin:1.5rem auto;padding:0 1rem}
h1{font-size:1.4rem;margin:0 0 .5rem}h2{font-size:1rem;margin:0 0 .25rem}
main{columns:2 22rem;column-gap:2rem}section{break-inside:avoid;margin:0 0 1rem}
table{width:100%;border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{padding:.1rem .3rem;border-bottom:1px solid #ccc;text-align:right;overflow-wrap:anywhere}
thead th,thead~tbody td{white-space:nowrap;overflow-wrap:normal}
th:first-child{text-align:left;font-weight:400}thead th{font-weight:600}
@media print{body{margin:0;max-width:none;font-size:10px}@page{margin:12mm}}`;

type Row = readonly [name: string, ...values: string[]];

/** @param language of the page, for its `lang` @returns HTML */
export function reportPage(report: SessionReport, language: string): string {
  const said = laterTexts().report;
  const sections = [
    sectionOf(said.driving, drivingRows(report)),
    sectionOf(said.interventions, interventionRows(report)),
    sectionOf(said.link, linkRows(report)),
    tableOf(said.link, [
      [said.bitRate, report.link.kbitPerSecond],
      [said.roundTrip, report.link.roundTripMs],
    ]),
    tableOf(said.view, [
      [said.frames, report.view.framesPerSecond],
      [said.points, report.view.pointsPerSecond],
      [said.display, report.view.displayFramesPerSecond],
      [said.age, report.view.ageMs],
    ]),
    tableOf(said.latency, latencyRows(report)),
  ];
  const title = `${said.title}: ${report.robot.name}`;
  return `<!doctype html>
<html lang="${escaped(language)}">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escaped(title)}</title>
<style>${STYLE}</style>
</head>
<body>
<h1>${escaped(title)}</h1>
<main>
${[sectionOf(null, headRows(report)), ...sections].join('\n')}
</main>
</body>
</html>
`;
}

/** Why a session ended, in the page's language; as it stands if it is unknown. */
function endText(end: string): string {
  const { report, events } = laterTexts();
  const own: Readonly<Record<string, string>> = {
    left: report.left,
    'new-session': report.newSession,
    'page-left': report.pageLeft,
  };
  return own[end] ?? events.losses[end] ?? end;
}

function headRows({ robot, operator, beganMs, endedMs, durationS, end }: SessionReport): Row[] {
  const said = laterTexts().report;
  const role = operator.role === null ? '' : ` (${operator.role})`;
  return [
    [said.robot, robot.name === robot.id ? robot.id : `${robot.name} (${robot.id})`],
    [said.operator, operator.name + role],
    [said.began, timeText(beganMs)],
    [said.ended, endedMs === null ? said.lasts : timeText(endedMs)],
    [said.duration, durationText(durationS)],
    ...(end === null ? [] : [[said.end, endText(end)] as const]),
  ];
}

function drivingRows({ driving }: SessionReport): Row[] {
  const said = laterTexts().report;
  const { leaseS, drivingS, standingS, unknownS, distanceM, positionJumps, topSpeedMps } = driving;
  return [
    [said.lease, durationText(leaseS)],
    [said.moving, durationText(drivingS)],
    [said.standing, durationText(standingS)],
    [said.unknown, durationText(unknownS)],
    [said.distance, `${distanceM.toFixed(1)} m`],
    [said.jumps, String(positionJumps)],
    [said.topSpeed, `${topSpeedMps.toFixed(2)} m/s`],
  ];
}

function interventionRows({ interventions: all }: SessionReport): Row[] {
  const { report: said, events } = laterTexts();
  const lasting = (times: number, seconds: number) => `${said.times(times)}, ${durationText(seconds)}`;
  const refused = Object.entries(all.commandsRefused);
  return [
    [said.stopsByYou, String(all.stopsByYou)],
    [said.stopsByOthers, String(all.stopsByOthers)],
    ...Object.entries(all.stopsByName).map(([name, times]) => [said.stopBy(name), String(times)] as const),
    [said.stopsByRobot, String(all.stopsByRobot)],
    [said.held, lasting(all.held, all.heldS)],
    [said.slowed, lasting(all.slowed, all.slowedS)],
    [said.blocked, String(all.blocked)],
    [said.watchdog, String(all.watchdog)],
    [said.letGoFirst, String(all.letGoFirst)],
    [said.gripLost, String(all.gripLost)],
    [said.handovers, String(all.handovers)],
    [said.takeovers, String(all.takeovers)],
    [said.alarms, String(all.alarms)],
    [said.refused, String(refused.reduce((sum, [, times]) => sum + times, 0))],
    ...refused.map(
      ([reason, times]) => [said.refusedBecause(events.rejections[reason] ?? reason), String(times)] as const,
    ),
  ];
}

function linkRows({ link }: SessionReport): Row[] {
  const said = laterTexts().report;
  const sent = link.packetsReceived + link.packetsLost;
  const lost = sent === 0 ? '–' : `${((100 * link.packetsLost) / sent).toFixed(2)} %`;
  return [
    [said.received, `${(link.bytesReceived / 1e6).toFixed(1)} MB`],
    [said.loss, lost],
    [said.outages, `${said.times(link.outages)}, ${durationText(link.outageS)}`],
    [said.longestOutage, `${link.longestOutageS.toFixed(1)} s`],
    [said.rateFalls, String(link.rateFalls)],
  ];
}

function latencyRows({ latency }: SessionReport): (readonly [string, Summary | null])[] {
  const said = laterTexts().report;
  const { frameMs, frameStagesMs, commandMs, commandStagesMs, motionToPhotonMs } = latency;
  const part = (name: string) => `– ${name}`;
  return [
    [said.frame, frameMs],
    ...Object.entries(said.frameStages).map(
      ([stage, name]) => [part(name), frameStagesMs[stage as keyof typeof frameStagesMs]] as const,
    ),
    [said.command, commandMs],
    ...Object.entries(said.commandStages).map(
      ([stage, name]) => [part(name), commandStagesMs[stage as keyof typeof commandStagesMs]] as const,
    ),
    [said.motionToPhoton, motionToPhotonMs],
  ];
}

function tableOf(title: string, rows: readonly (readonly [string, Summary | null])[]): string {
  const said = laterTexts().report;
  const head: Row = ['', said.median, said.p95, said.most, said.mean, said.samples];
  return sectionOf(
    title,
    rows.map(([name, summary]) => [name, ...summaryTexts(summary)]),
    head,
  );
}

function summaryTexts(summary: Summary | null): string[] {
  if (summary === null) return ['–', '–', '–', '–', '0'];
  const { p50, p95, max, mean, count } = summary;
  return [...[p50, p95, max, mean].map(numberText), String(count)];
}

/** Three digits. */
function numberText(value: number): string {
  const size = Math.abs(value);
  return value.toFixed(size >= 100 ? 0 : size >= 10 ? 1 : 2);
}

function timeText(epochMs: number): string {
  return new Date(epochMs).toISOString().replace('T', ' ').slice(0, 19).concat(' UTC');
}

function sectionOf(title: string | null, rows: readonly Row[], head?: Row): string {
  const heading = title === null ? '' : `<h2>${escaped(title)}</h2>`;
  const headRow = head === undefined ? '' : `<thead><tr>${head.map(headCell).join('')}</tr></thead>`;
  const body = rows.map(([name, ...values]) => {
    const cells = values.map((value) => `<td>${escaped(value)}</td>`).join('');
    return `<tr><th scope="row">${escaped(name)}</th>${cells}</tr>`;
  });
  return `<section>${heading}<table>${headRow}<tbody>${body.join('')}</tbody></table></section>`;
}

function headCell(text: string): string {
  return text === '' ? '<td></td>' : `<th scope="col">${escaped(text)}</th>`;
}

/** As text or as an attribute's value in quotes. */
function escaped(text: string): string {
  const entities: Readonly<Record<string, string>> = {
    '&': '&amp;',
    '<': '&lt;',
    '>': '&gt;',
    '"': '&quot;',
    "'": '&#39;',
  };
  return text.replaceAll(/[&<>"']/g, (letter) => entities[letter] ?? letter);
}
