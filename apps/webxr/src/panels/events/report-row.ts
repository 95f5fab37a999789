/** The row of the event log from which the report of a session is saved. */
import type { SessionReport } from '../../ground/report/report-schema.ts';
import { laterTexts, texts } from '../../words/language.ts';
import { sessionText } from '../../words/session-text.ts';
import { quietButton } from '../ui/panel-parts.ts';
import { saveReportJson, saveReportPage } from './report-files.ts';

export interface ReportRow {
  readonly element: HTMLElement;
  /** Lists the sessions as they are now. */
  update(): void;
}

/** @param all the sessions of this tab, the newest first, as they are now */
export function reportRow(all: () => readonly SessionReport[]): ReportRow {
  const said = laterTexts().report;
  const { saveReport, saveReportTitle } = texts().dialogs;
  const element = document.createElement('div');
  element.className = 'reports';
  const select = document.createElement('select');
  select.ariaLabel = said.choose;
  /** Saves the session that is chosen, as it is now. */
  const save = (write: (report: SessionReport) => void) => {
    const report = all()[select.selectedIndex];
    if (report !== undefined) write(report);
  };
  const page = quietButton(saveReport, saveReportTitle, () => save(saveReportPage));
  const json = quietButton(said.saveJson, said.saveJsonTitle, () => save(saveReportJson));
  element.append(select, page, json);
  return {
    element,
    update() {
      const reports = all();
      select.replaceChildren(...reports.map((report) => new Option(sessionText(report))));
      if (reports.length === 0) select.append(new Option(said.none));
      for (const each of [select, page, json]) each.disabled = reports.length === 0;
    },
  };
}
