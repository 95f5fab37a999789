/** A real Prometheus loads the alerts, scrapes the real programs, and answers every query of the dashboards. */
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { findProgram, freePorts, LocalStack, ManagedProcess } from '@farpoint/local-stack';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { stringify } from 'yaml';
import { alertRules } from './alerts.ts';
import { dashboards } from './dashboards.ts';

const prometheus = findProgram(['prometheus']);
const promtool = findProgram(['promtool']);
const RULES = new URL('../prometheus/alerts.yaml', import.meta.url).pathname;
const queries = dashboards.flatMap(({ title, rows }) =>
  rows.flatMap(({ panels }) =>
    panels.flatMap((panel) => panel.queries.map(({ expr }) => ({ title, panel: panel.title, expr }))),
  ),
);
/** As Grafana fills in the variables. */
const filled = (expr: string) => expr.replaceAll('$robot', '.*').replaceAll('$__rate_interval', '1m');

interface Answer {
  status: string;
  error?: string;
  data: { result: { metric: Record<string, string>; value: [number, string] }[] };
}

describe.skipIf(prometheus === null || promtool === null)(
  'Prometheus (needs apt-get install prometheus)',
  () => {
    let folder: string;
    let stack: LocalStack;
    let server: ManagedProcess;
    let url: string;
    let metrics: string;

    beforeAll(async () => {
      folder = mkdtempSync(join(tmpdir(), 'farpoint-prometheus-'));
      stack = await LocalStack.start({
        robots: [{ id: 'sim-1', name: 'Robot', args: ['--source', 'sim', '--sim-size', '32', '--fps', '5'] }],
        signalingArgs: ['--public-metrics'],
      });
      const [port] = await freePorts(1);
      url = `http://127.0.0.1:${port}`;
      const target = (address: string) => [{ targets: [new URL(address).host] }];
      const config = {
        global: { scrape_interval: '200ms', evaluation_interval: '200ms' },
        rule_files: [RULES],
        scrape_configs: [
          { job_name: 'farpoint-robot', static_configs: target(stack.robotAdminUrl('sim-1')) },
          { job_name: 'farpoint-signaling', static_configs: target(stack.webUrl) },
        ],
      };
      writeFileSync(join(folder, 'prometheus.yml'), stringify(config));
      server = await ManagedProcess.start({
        name: 'prometheus',
        command: [
          prometheus as string,
          ...[
            `--config.file=${join(folder, 'prometheus.yml')}`,
            `--storage.tsdb.path=${join(folder, 'data')}`,
          ],
          `--web.listen-address=127.0.0.1:${port}`,
        ],
        cwd: folder,
        readyUrl: `${url}/-/ready`,
      });
      const texts = [`${stack.robotAdminUrl('sim-1')}/metrics`, `${stack.webUrl}metrics`].map(async (each) =>
        (await fetch(each)).text(),
      );
      metrics = (await Promise.all(texts)).join('\n');
      while ((await ask('up == 1')).data.result.length < 2)
        await new Promise((resolve) => setTimeout(resolve, 50));
    });

    afterAll(async () => {
      await server?.stop();
      await stack?.stop();
      rmSync(folder, { recursive: true, force: true });
    });

    async function ask(query: string): Promise<Answer> {
      const response = await fetch(`${url}/api/v1/query?${new URLSearchParams({ query })}`);
      return (await response.json()) as Answer;
    }

    /** Metrics that no program has: typing mistakes, or metrics that were renamed. */
    const unknown = (expr: string) =>
      [...new Set(expr.match(/\b(farpoint|process|nodejs)_[a-z_]+/g))].filter(
        (name) => !metrics.includes(`# TYPE ${name.replace(/_bucket$/, '')} `),
      );

    test.each(queries)('answers “$panel” of “$title”: $expr', async ({ expr }) => {
      expect(unknown(expr)).toEqual([]);
      expect(await ask(filled(expr))).toMatchObject({ status: 'success' });
    });

    test.each(alertRules)('has the alert $name, which is silent here', async ({ name, expr }) => {
      expect(unknown(expr)).toEqual([]);
      expect(await ask(expr)).toMatchObject({ status: 'success', data: { result: [] } });
      const answer = (await (await fetch(`${url}/api/v1/rules`)).json()) as {
        data: { groups: { rules: { name: string; health: string; lastError?: string }[] }[] };
      };
      const rule = answer.data.groups.flatMap(({ rules }) => rules).find((each) => each.name === name);
      expect(rule?.lastError ?? '').toBe('');
    });

    test('finds no fault in the rules', () => {
      const { status, stdout, stderr } = spawnSync(promtool as string, ['check', 'rules', RULES], {
        encoding: 'utf8',
      });
      expect(status, stdout + stderr).toBe(0);
      expect(stdout).toContain(`${alertRules.length} rules found`);
    });

    test('a program that is gone raises its alert', async () => {
      await stack.robot('sim-1').kill();
      const rule = alertRules.find(({ name }) => name === 'FarpointProgramGone');
      while ((await ask(rule?.expr ?? '')).data.result.length === 0)
        await new Promise((resolve) => setTimeout(resolve, 50));
      const { data } = await ask(rule?.expr ?? '');
      expect(data.result[0]?.metric).toMatchObject({ job: 'farpoint-robot' });
    });
  },
);
