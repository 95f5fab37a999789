/** `farpoint-robot doctor`: checks everything that a robot needs, and says what to do about each fault. */
import { checkConfiguration } from '../doctor/check-configuration.ts';
import { configurationCheck, machineChecks, robotChecks } from '../doctor/checks.ts';
import { type Finding, runCheck } from '../doctor/finding.ts';
import { thisHost } from '../doctor/host.ts';
import { countVerdicts, findingLine, jsonReport, summaryLine } from '../doctor/report.ts';
import { graphsOf } from '../doctor/ros-probe.ts';
import type { CommandRim } from './init.ts';

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
