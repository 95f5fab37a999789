/** `farpoint-robot doctor`: checks everything that a robot needs, and says what to do about each fault. */

import { withoutCredentials } from '@farpoint/service';
import { checkConfiguration } from '../doctor/check-configuration.ts';
import { configurationCheck, machineChecks, robotChecks } from '../doctor/checks.ts';
import { type Finding, runCheck, type Verdict } from '../doctor/finding.ts';
import { thisHost } from '../doctor/host.ts';
import { graphsOf } from '../doctor/ros-probe.ts';
import type { CommandRim } from './init.ts';

const SIGNS: Record<Verdict, string> = { ok: '✓', warn: '!', fail: '✗' };
const NAME_WIDTH = 15;

/** The finding and its remedy in one line. */
export function findingLine({ check, verdict, detail, remedy }: Finding): string {
  const what = remedy === undefined ? detail : `${detail} → ${remedy}`;
  // A message from another program may contain newlines.
  return `${SIGNS[verdict]} ${check.padEnd(NAME_WIDTH)} ${withoutCredentials(what.replaceAll(/\s*\n\s*/g, '; '))}\n`;
}

/** What all findings come to, for people. */
export function summaryLine(findings: readonly Finding[]): string {
  const { fail, warn } = countVerdicts(findings);
  if (fail > 0) return `${fail} to fix${warn > 0 ? `, ${warn} worth a look` : ''}.\n`;
  return warn > 0 ? `Ready; ${warn} worth a look.\n` : 'Ready.\n';
}

/** `--json`: a single object. */
export function jsonReport(findings: readonly Finding[]): string {
  const { fail } = countVerdicts(findings);
  return `${withoutCredentials(JSON.stringify({ ready: fail === 0, findings }, null, 2))}\n`;
}

function countVerdicts(findings: readonly Finding[]): Record<Verdict, number> {
  const counts = { ok: 0, warn: 0, fail: 0 };
  for (const { verdict } of findings) counts[verdict]++;
  return counts;
}

const HELP = `farpoint-robot doctor [--json] [any option of farpoint-robot]

Checks the configuration, this machine, the network, the servers and the source, as a robot with these options would
use them. Each result is one line: ✓ passed, ! worth a look, ✗ must be fixed. The doctor briefly registers the robot's id
with the signaling service; a robot that is already registered is not disturbed.

  --json   one JSON object: {ready, findings: [{check, verdict, detail, remedy}]}

Exit code: 0 if there is no ✗, else 1.
`;

/** @returns the exit code */
export async function doctor(
  argv: readonly string[],
  { stdout, env }: CommandRim & { env: Readonly<Record<string, string | undefined>> },
): Promise<number> {
  if (argv.includes('--help') || argv.includes('-h')) {
    stdout.write(HELP);
    return 0;
  }
  const json = argv.includes('--json');
  const configuration = checkConfiguration(
    argv.filter((argument) => argument !== '--json'),
    env,
  );
  const { robot, values } = configuration;
  const checks = [
    configurationCheck(configuration),
    ...machineChecks(
      thisHost,
      robot !== null && graphsOf(robot, []).some(({ graph }) => graph.kind === 'ros2'),
    ),
    ...(robot === null || values === null ? [] : robotChecks(robot, values)),
  ];
  const findings: Finding[] = [];
  for (const check of checks) {
    const found = await runCheck(check);
    findings.push(...found);
    if (!json) for (const finding of found) stdout.write(findingLine(finding));
  }
  stdout.write(json ? jsonReport(findings) : `\n${summaryLine(findings)}`);
  return countVerdicts(findings).fail > 0 ? 1 : 0;
}
