// SPDX-License-Identifier: BSD-3-Clause
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <string>

#include "plan_readers.h"

namespace ridgemap::apps
{
namespace
{
constexpr int piecesPerCurve = 16;

/** Numbers and commands of path data, one after the other. */
class PathScanner
{
 public:
	explicit PathScanner(const std::string& text) : at_(text.data()), end_(at_ + text.size()) {}

	bool atEnd()
	{
		skip();
		return at_ == end_;
	}

	/** The next command letter, or 0 if a number comes next. */
	char command()
	{
		skip();
		return at_ != end_ && std::isalpha(static_cast<unsigned char>(*at_)) ? *at_++ : '\0';
	}

	double number()
	{
		skip();
		if (at_ != end_ && *at_ == '+') at_++;
		double v = 0;
		const auto [rest, error] = std::from_chars(at_, end_, v);
		if (error != std::errc())
			throw std::invalid_argument("there is no number at '" + std::string(at_, std::min(end_, at_ + 10)) + "'");
		at_ = rest;
		return v;
	}

 private:
	const char *at_, *end_;

	void skip()
	{
		while (at_ != end_ && (std::isspace(static_cast<unsigned char>(*at_)) || *at_ == ',')) at_++;
	}
};

class PathReader
{
 public:
	explicit PathReader(const std::string& data) : in_(data) {}

	std::vector<Polyline> read()
	{
		char command = 0;
		while (!in_.atEnd())
		{
			if (const char next = in_.command())
				command = next;
			else if (command == 'M' || command == 'm')
				command = command == 'M' ? 'L' : 'l';
			else if (command == 0 || command == 'Z' || command == 'z')
				throw std::invalid_argument("a number stands where a command is due");
			apply(command);
		}
		finish();
		return std::move(lines_);
	}

 private:
	PathScanner in_;
	std::vector<Polyline> lines_;
	Polyline line_;
	Point2 at_, start_;

	void finish()
	{
		if (line_.points.size() > 1) lines_.push_back(line_);
		line_ = Polyline();
	}

	void lineTo(const Point2& p)
	{
		if (line_.points.empty()) line_.points.push_back(at_);
		line_.points.push_back(p);
		at_ = p;
	}

	Point2 point(bool relative)
	{
		const double x = in_.number(), y = in_.number();
		return relative ? Point2{at_.x + x, at_.y + y} : Point2{x, y};
	}

	void cubic(const Point2& b, const Point2& c, const Point2& d)
	{
		const Point2 a = at_;
		for (int i = 1; i <= piecesPerCurve; i++)
		{
			const double t = double(i) / piecesPerCurve, s = 1 - t;
			const double wa = s * s * s, wb = 3 * s * s * t, wc = 3 * s * t * t, wd = t * t * t;
			lineTo({wa * a.x + wb * b.x + wc * c.x + wd * d.x, wa * a.y + wb * b.y + wc * c.y + wd * d.y});
		}
	}

	void quadratic(const Point2& b, const Point2& c)
	{
		const Point2 a = at_;
		const auto mid = [](const Point2& p, const Point2& q) {
			return Point2{p.x + (q.x - p.x) * 2 / 3, p.y + (q.y - p.y) * 2 / 3};
		};
		cubic(mid(a, b), mid(c, b), c);
	}

	void close()
	{
		if (line_.points.size() > 2)
		{
			if (line_.points.back() != start_) line_.points.push_back(start_);
			line_.closed = line_.points.size() > 3;
		}
		finish();
		at_ = start_;
	}

	void apply(char command)
	{
		const bool relative = command >= 'a';
		switch (std::toupper(static_cast<unsigned char>(command)))
		{
			case 'M':
				finish();
				at_ = start_ = point(relative);
				return;
			case 'L':
				return lineTo(point(relative));
			case 'H':
				return lineTo({in_.number() + (relative ? at_.x : 0), at_.y});
			case 'V':
				return lineTo({at_.x, in_.number() + (relative ? at_.y : 0)});
			case 'C':
			{
				const Point2 b = point(relative), c = point(relative), d = point(relative);
				return cubic(b, c, d);
			}
			case 'Q':
			{
				const Point2 b = point(relative), c = point(relative);
				return quadratic(b, c);
			}
			case 'Z':
				return close();
			default:
				throw std::invalid_argument(std::string("the path command '") + command + "' is not supported");
		}
	}
};
}  // namespace

std::vector<Polyline> parseSvgPath(const std::string& data)
{
	return PathReader(data).read();
}

std::vector<double> parseNumbers(const std::string& text)
{
	PathScanner in(text);
	std::vector<double> numbers;
	while (!in.atEnd()) numbers.push_back(in.number());
	return numbers;
}

}  // namespace ridgemap::apps
