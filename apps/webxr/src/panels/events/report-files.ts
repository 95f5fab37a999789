/** Saves the report of a session: as a page for people, and as JSON for programs. */
import type { SessionReport } from '../../ground/report/report-schema.ts';
import { language } from '../../words/language.ts';
import { reportPage } from '../../words/report-page.ts';
import { saveFile } from '../ui/save-file.ts';

export function saveReportPage(report: SessionReport): void {
  const page = reportPage(report, language());
  saveFile('session', 'html', new Blob([page], { type: 'text/html' }));
}

export function saveReportJson(report: SessionReport): void {
  const text = `${JSON.stringify(report, null, 2)}\n`;
  saveFile('session', 'json', new Blob([text], { type: 'application/json' }));
}
