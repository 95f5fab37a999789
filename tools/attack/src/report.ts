import type { AttackResult, Outcome } from './run-attacks.ts';
import type { FloodResult } from './run-flood.ts';

const MARKS: Record<Outcome, string> = { held: '✓', harmed: '✗', 'not tried': '–' };

/** One line of the table: attack, layer, outcome, time. */
export function row({ name, layer, outcome, detail, tally, seconds }: AttackResult): string {
  const line = `${MARKS[outcome]} ${layer.padEnd(9)}  ${name.padEnd(58)}  ${outcome.padEnd(9)}  ${seconds.toFixed(1).padStart(5)} s`;
  const text = detail ?? tally?.text ?? null;
  return text === null ? line : `${line}\n    ${text}`;
}

export function printSummary(results: readonly AttackResult[]): void {
  const count = (outcome: Outcome) => results.filter((result) => result.outcome === outcome).length;
  console.error(
    `${results.length} attacks: ${count('held')} held, ${count('harmed')} harmed, ${count('not tried')} not tried`,
  );
  const counted = results.flatMap(({ tally }) => (tally === null ? [] : [tally.packets]));
  if (counted.length > 0) {
    const packets = counted.reduce((sum, one) => sum + one, 0);
    console.error(`${counted.length} patterns of an admitted watcher, ${packets} packets`);
  }
}

const ms = (value: number | null) => (value === null ? '–' : value.toFixed(1)).padStart(8);
const megabytes = (bytes: number) => (bytes / 2 ** 20).toFixed(0).padStart(7);

export function printFlood(results: readonly FloodResult[]): void {
  console.log(
    `${'datagrams'.padEnd(34)}   sent/s  round trip, ms  command to frame    sessions  robot, MB\n` +
      `${' '.repeat(34)}            before  during   before  during       lost  before  after`,
  );
  for (const one of results) {
    const { before, during } = one;
    console.log(
      `${one.name.padEnd(34)} ${one.perSecond.toFixed(0).padStart(8)} ${ms(before.roundTripP95Ms)}${ms(during.roundTripP95Ms)} ` +
        `${ms(before.commandToFrameP95Ms)}${ms(during.commandToFrameP95Ms)} ${String(one.sessionsLost).padStart(10)} ` +
        `${megabytes(one.bytesBefore)}${megabytes(one.bytesAfter)}${one.harm === null ? '' : `\n    ${one.harm}`}`,
    );
  }
}
