/** The line in the list of robots about the session that is over, with its report. */
import { effect } from '@preact/signals-core';
import type { SessionReports } from '../../ground/report/session-reports.ts';
import { texts } from '../../words/language.ts';
import { durationText } from '../../words/session-text.ts';
import { elements } from '../ui/elements.ts';
import { quietButton } from '../ui/panel-parts.ts';

/** Shows it from now on, once there is one. */
export function showLastSession(reports: Pick<SessionReports, 'ended'>): void {
  const line = document.createElement('p');
  line.id = 'last-session';
  line.className = 'hint small';
  const text = document.createElement('span');
  const save = quietButton('', '', () => {
    const [last] = reports.ended.peek();
    // The page starts without the code of reports.
    if (last !== undefined) void import('./report-files.ts').then((files) => files.saveReportPage(last));
  });
  line.append(text, ' ', save);
  elements.robots.append(line);
  effect(() => {
    const [last] = reports.ended.value;
    line.hidden = last === undefined;
    if (last === undefined) return;
    const { saveReport, saveReportTitle, lastSession } = texts().dialogs;
    save.textContent = saveReport;
    save.title = saveReportTitle;
    text.textContent = lastSession(last.robot.name, durationText(last.durationS));
  });
}
