// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/atomic_file.h>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <ostream>

#include "report.h"

namespace ridgemap::apps
{
namespace
{
constexpr const char* style =
	"body{font:16px/1.5 sans-serif;max-width:1500px;margin:2em auto;padding:0 1em;color:#222}"
	"section{border-top:1px solid #ccc;padding:1em 0}"
	".side{display:flex;gap:2em;align-items:flex-start;flex-wrap:wrap}"
	".side>div:first-child{flex:3 1 600px}.side>div:last-child{flex:2 1 360px}"
	"img{width:100%;border:1px solid #ddd}"
	"table{border-collapse:collapse;font-size:14px}td,th{padding:2px 10px;text-align:right;border-bottom:1px solid "
	"#eee}"
	".v{display:inline-block;padding:0 .6em;border-radius:.6em;color:#fff;font-size:14px}"
	".holds{background:#2e7d32}.differs{background:#c62828}.beyond{background:#1565c0}";

const char* nameOf(Verdict v)
{
	return v == Verdict::holds ? "holds" : v == Verdict::differs ? "differs" : "beyond";
}

const char* sentenceOf(Verdict v)
{
	return v == Verdict::holds ? "reproduced" : v == Verdict::differs ? "not as in the paper" : "beyond the paper";
}

std::string escaped(const std::string& text)
{
	std::string out;
	for (const char c : text)
		if (c == '<')
			out += "&lt;";
		else if (c == '>')
			out += "&gt;";
		else if (c == '&')
			out += "&amp;";
		else
			out += c;
	return out;
}

/** Whole numbers in full, others with five digits. */
std::string cell(double v)
{
	return v == std::floor(v) && std::abs(v) < 1e9 ? format("%.0f", v) : format("%.5g", v);
}

void writeHtmlTable(std::ostream& out, const Table& t)
{
	if (t.rows.empty()) return;
	out << "<table><tr>";
	for (const std::string& c : t.columns) out << "<th>" << escaped(c) << "</th>";
	out << "</tr>\n";
	for (const auto& row : t.rows)
	{
		out << "<tr>";
		for (const double v : row) out << "<td>" << cell(v) << "</td>";
		out << "</tr>\n";
	}
	out << "</table>\n";
}

void writeHtml(std::ostream& out, const std::vector<Finding>& findings, const std::string& note)
{
	out << "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>The paper, reproduced</title><style>"
		<< style << "</style>\n<h1>The paper, reproduced</h1>\n<p>" << escaped(note) << "</p>\n";
	for (const Finding& f : findings)
	{
		out << "<section id=\"" << f.id << "\"><h2>" << escaped(f.title) << " <span class=\"v " << nameOf(f.verdict)
			<< "\">" << sentenceOf(f.verdict) << "</span></h2>\n<div class=\"side\"><div>";
		for (const std::string& p : f.pictures) out << "<img src=\"" << p << "\" alt=\"" << escaped(f.title) << "\">\n";
		if (f.pictures.empty()) writeHtmlTable(out, f.table);
		out << "</div><div><h3>The paper says</h3><p>" << escaped(f.claim) << "</p><h3>Found here</h3><p>"
			<< escaped(f.result) << "</p>\n";
		if (!f.pictures.empty()) writeHtmlTable(out, f.table);
		out << "<p>Data:";
		if (!f.table.rows.empty()) out << " <a href=\"" << f.id << ".csv\">" << f.id << ".csv</a>";
		if (!f.data.empty()) out << " <a href=\"" << f.data << "\">" << f.data << "</a>";
		out << "</p></div></div></section>\n";
	}
	out << "</html>\n";
}

void writeMarkdown(std::ostream& out, const std::vector<Finding>& findings, const std::string& note)
{
	out << "# The paper, reproduced\n\n`scripts/reproduce.sh --docs` renews this page; do not edit. " << note << "\n\n";
	out << "| experiment | |\n|---|---|\n";
	for (const Finding& f : findings) out << "| " << f.title << " | " << sentenceOf(f.verdict) << " |\n";
	for (const Finding& f : findings)
	{
		out << "\n## " << f.title << "\n\n";
		for (const std::string& p : f.pictures) out << "![" << f.title << "](images/paper/" << p << ")\n\n";
		out << "**The paper:** " << f.claim << "\n\n**Here:** " << f.result << "\n";
		if (f.table.rows.empty()) continue;
		out << "\n|";
		for (const std::string& c : f.table.columns) out << " " << c << " |";
		out << "\n|";
		for (std::size_t i = 0; i < f.table.columns.size(); i++) out << "---:|";
		out << "\n";
		for (const auto& row : f.table.rows)
		{
			out << "|";
			for (const double v : row) out << " " << cell(v) << " |";
			out << "\n";
		}
	}
}

}  // namespace

std::string format(const char* pattern, ...)
{
	char text[4000];
	va_list arguments;
	va_start(arguments, pattern);
	std::vsnprintf(text, sizeof(text), pattern, arguments);
	va_end(arguments);
	return text;
}

void writeCsv(const std::string& path, const Table& table)
{
	AtomicFile file(path);
	std::ostream& out = file.stream();
	for (std::size_t i = 0; i < table.columns.size(); i++) out << (i > 0 ? "," : "") << table.columns[i];
	out << "\n";
	for (const auto& row : table.rows)
	{
		for (std::size_t i = 0; i < row.size(); i++) out << (i > 0 ? "," : "") << format("%.9g", row[i]);
		out << "\n";
	}
	file.commit();
}

void writeReport(const Setting& setting, const std::vector<Finding>& findings, const std::string& note)
{
	AtomicFile html(setting.path("index.html")), markdown(setting.path("paper.md"));
	writeHtml(html.stream(), findings, note);
	writeMarkdown(markdown.stream(), findings, note);
	for (const Finding& f : findings)
		if (!f.table.rows.empty()) writeCsv(setting.path(f.id + ".csv"), f.table);
	html.commit();
	markdown.commit();
}

}  // namespace ridgemap::apps
