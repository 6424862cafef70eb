// SPDX-License-Identifier: BSD-3-Clause
#include <ridgemap/atomic_file.h>

#include <charconv>
#include <cmath>
#include <ostream>

#include "drawing_canvas.h"

namespace ridgemap
{
namespace
{
using drawing::Anchor;
using drawing::Color;
using drawing::Layout;

/** Fixed number of decimals without trailing zeros, whatever the locale. */
std::string number(double v, int decimals)
{
	char s[400];
	char* end = std::to_chars(s, s + sizeof(s), v, std::chars_format::fixed, decimals).ptr;
	if (decimals > 0)
	{
		while (end[-1] == '0') end--;
		if (end[-1] == '.') end--;
	}
	const std::string text(s, end);
	return text == "-0" ? "0" : text;
}

std::string escaped(const std::string& s)
{
	std::string out;
	for (const char c : s) switch (c)
		{
			case '&':
				out += "&amp;";
				break;
			case '<':
				out += "&lt;";
				break;
			case '>':
				out += "&gt;";
				break;
			case '"':
				out += "&quot;";
				break;
			default:
				// Other control characters are not allowed in XML at all.
				out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
		}
	return out;
}

std::string hex(Color c)
{
	constexpr char digits[] = "0123456789abcdef";
	std::string s = "#";
	for (const int v : {c.r, c.g, c.b}) s += {digits[v / 16], digits[v % 16]};
	return s;
}

class SvgCanvas : public drawing::Canvas
{
 public:
	SvgCanvas(std::ostream& out, const Layout& layout) : out_(out), layout_(layout)
	{
		// A tenth of a pixel is enough, and keeps the file small.
		decimals_ = std::max(0, int(std::ceil(std::log10(layout.scale))) + 1);
		const std::string w = number(layout.pageWidth, 2), h = number(layout.pageHeight, 2);
		out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << w << ' ' << h << "\" width=\"" << w
			 << "\" height=\"" << h << "\" font-family=\"Helvetica, Arial, sans-serif\">\n"
			 << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<clipPath id=\"frame\"><rect x=\""
			 << number(layout.left, 2) << "\" y=\"" << number(layout.top, 2) << "\" width=\"" << number(layout.width, 2)
			 << "\" height=\"" << number(layout.height, 2) << "\"/></clipPath>\n";
	}

	/** Each row of dots is one path of relative moves: a few bytes a dot. */
	void mapDots(const std::vector<Point2>& points, double diameter, Color color) override
	{
		openMap(diameter, color, "square");
		out_ << "<path d=\"";
		Point2 last{std::nan(""), std::nan("")};
		for (const Point2& p : drawing::thinnedMeasurements(layout_, points, 2 * layout_.unit))
		{
			if (p.y == last.y)
				out_ << 'm' << number(p.x - last.x, decimals_) << " 0h0";
			else
				out_ << "\nM" << number(p.x, decimals_) << ' ' << number(p.y, decimals_) << "h0";
			// Relative moves start from the rounded position.
			last = {
				p.y == last.y ? last.x + std::stod(number(p.x - last.x, decimals_)) : std::stod(number(p.x, decimals_)),
				p.y};
		}
		out_ << "\"/>\n";
		closeMap();
	}

	void mapLines(const std::vector<const std::vector<Point2>*>& lines, double width, Color color) override
	{
		openMap(width, color, "round");
		for (const auto* line : lines)
		{
			if (line->empty()) continue;
			out_ << "<polyline points=\"";
			const char* separator = "";
			for (const Point2& p : *line)
			{
				out_ << separator << number(p.x, decimals_) << ',' << number(p.y, decimals_);
				separator = " ";
			}
			out_ << "\"/>\n";
		}
		closeMap();
	}

	void line(double x1, double y1, double x2, double y2, double width, Color color) override
	{
		out_ << "<path d=\"M" << number(x1, 2) << ' ' << number(y1, 2) << 'L' << number(x2, 2) << ' ' << number(y2, 2)
			 << "\" stroke=\"" << hex(color) << "\" stroke-width=\"" << number(width, 2) << "\"/>\n";
	}

	void text(double x, double y, const std::string& s, double size, Anchor anchor, Color color) override
	{
		const char* names[] = {"start", "middle", "end"};
		out_ << "<text x=\"" << number(x, 2) << "\" y=\"" << number(y, 2) << "\" font-size=\"" << number(size, 2)
			 << "\" text-anchor=\"" << names[int(anchor)] << "\" fill=\"" << hex(color) << "\">" << escaped(s)
			 << "</text>\n";
	}

	void verticalText(double x, double y, const std::string& s, double size, Color color) override
	{
		out_ << "<text transform=\"translate(" << number(x, 2) << ' ' << number(y, 2) << ") rotate(-90)\" font-size=\""
			 << number(size, 2) << "\" text-anchor=\"middle\" fill=\"" << hex(color) << "\">" << escaped(s)
			 << "</text>\n";
	}

	void close() { out_ << "</svg>\n"; }

 private:
	std::ostream& out_;
	const Layout& layout_;
	int decimals_ = 3;  ///< of coordinates in metres

	/** Inside, user units are metres of the map frame with y up. */
	void openMap(double width, Color color, const char* cap)
	{
		const double s = layout_.scale;
		out_ << "<g clip-path=\"url(#frame)\"><g transform=\"matrix(" << number(s, 9) << " 0 0 " << number(-s, 9) << ' '
			 << number(layout_.px(0), 6) << ' ' << number(layout_.py(0), 6) << ")\" fill=\"none\" stroke=\""
			 << hex(color) << "\" stroke-width=\"" << number(width / s, decimals_ + 2) << "\" stroke-linecap=\"" << cap
			 << "\" stroke-linejoin=\"round\">\n";
	}
	void closeMap() { out_ << "</g></g>\n"; }
};

}  // namespace

void writeSvg(std::ostream& out, const Drawing& drawing)
{
	const Layout layout = drawing::makeLayout(drawing);
	SvgCanvas canvas(out, layout);
	drawing::draw(canvas, layout, drawing);
	canvas.close();
}

void writeSvg(const std::string& path, const Drawing& drawing)
{
	AtomicFile file(path);
	writeSvg(file.stream(), drawing);
	file.commit();
}

}  // namespace ridgemap
